# Compiles a kernel text as a module of the CPU: a right one, and one whose third line has an unknown word.
function(compile word)
  file(WRITE ${FOLDER}/crooked.kernel
       "// Line 1 of the kernel.\n"
       "KFN void segment_kernel(segment q, OUT(vec3r) c, OUT(spectral) t) {\n"
       "  c = v3(R(0.0), ${word}, R(0.0));\n"
       "  t = spectral_of(v3(R(1.0), R(1.0), R(1.0)));\n"
       "}\n")
  execute_process(
    COMMAND ${COMPILER} -std=c++20 -fsyntax-only -I ${SOURCE} -DDVR_KERNEL_FILE="${FOLDER}/crooked.kernel"
            -DDVR_KERNEL_NAME="crooked" -DDVR_ISA_scalar=1 -DDVR_HAS_VOXELS=0 -DDVR_WALKING=0
            ${SOURCE}/framework/kernel/cpu/estimator.module.cpp
    RESULT_VARIABLE rc ERROR_VARIABLE said)
  set(rc ${rc} PARENT_SCOPE)
  set(said "${said}" PARENT_SCOPE)
endfunction()

compile("R(0.5)")
if(NOT rc EQUAL 0)
  message(FATAL_ERROR "the right kernel does not compile: ${said}")
endif()
compile(crookedness)
if(rc EQUAL 0 OR NOT said MATCHES "crooked\\.kernel:3:[0-9]+: error: .*crookedness")
  message(FATAL_ERROR "the kernel's file and line are not named: ${said}")
endif()

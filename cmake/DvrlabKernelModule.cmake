# Kernel modules: one shared library per instruction set from the same text. Each exports one C function and
# nothing else (version script), so that no inline function of one instruction set can replace another's.
set(DVRLAB_ISAS scalar sse4.2 avx2 avx512)
set(DVRLAB_FLAGS_scalar "")
set(DVRLAB_FLAGS_sse4.2 -msse4.2)
set(DVRLAB_FLAGS_avx2 -mavx2)
set(DVRLAB_FLAGS_avx512 -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512)
# Bit-identical arithmetic: no contraction, no value-changing optimisation. always_inline helpers and the
# kernel's text sit in one function, which -fno-trapping-math lets the compiler if-convert.
set(DVRLAB_MODULE_FLAGS -O3 -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-gnu-unique -fno-exceptions
    -fno-rtti -fvisibility=hidden -fno-semantic-interposition -Wno-psabi
    -Wno-maybe-uninitialized -Wno-uninitialized) # the last two: false alarms of g++ 12's own avx512 headers

# dvrlab_add_kernel_modules(kind name kernel_file output_folder): sets DVRLAB_MODULE_TARGETS in the caller.
function(dvrlab_add_kernel_modules kind name kernel out)
  set(targets "")
  set(has_voxels 0)
  if(kernel)
    file(STRINGS ${kernel} voxel_words REGEX "VOXELS\\(")
    if(voxel_words)
      set(has_voxels 1)
    endif()
  endif()
  foreach(isa ${DVRLAB_ISAS})
    string(REPLACE "." "_" isa_id ${isa})
    set(target dvrlab_${kind}_${name}_${isa_id})
    add_library(${target} MODULE ${CMAKE_SOURCE_DIR}/framework/kernel/cpu/${kind}.module.cpp)
    target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR})
    target_compile_definitions(${target} PRIVATE DVR_KERNEL_FILE="${kernel}" DVR_KERNEL_NAME="${name}" DVR_ISA_${isa_id}=1 DVR_HAS_VOXELS=${has_voxels})
    target_compile_options(${target} PRIVATE ${DVRLAB_MODULE_FLAGS} ${DVRLAB_FLAGS_${isa}})
    target_link_libraries(${target} PRIVATE dvrlab_warnings)
    target_link_options(${target} PRIVATE -Wl,--version-script=${CMAKE_SOURCE_DIR}/framework/kernel/cpu/module.map -Wl,-z,defs)
    set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name}.${isa} LIBRARY_OUTPUT_DIRECTORY ${out})
    list(APPEND targets ${target})
  endforeach()
  set(DVRLAB_MODULE_TARGETS ${targets} PARENT_SCOPE)
endfunction()

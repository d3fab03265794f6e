# Kernel modules: one shared library per instruction set from the same text, and one in double (fp64, one lane). Each exports one C function and
# nothing else (version script), so that no inline function of one instruction set can replace another's.
# DVRLAB_ROOT holds framework/: the source tree, or the installed headers (dvrlabConfig.cmake).
set(DVRLAB_ISAS scalar sse4.2 avx2 avx512)
set(DVRLAB_FLAGS_fp64 "")
set(DVRLAB_FLAGS_scalar "")
set(DVRLAB_FLAGS_sse4.2 -msse4.2)
set(DVRLAB_FLAGS_avx2 -mavx2)
set(DVRLAB_FLAGS_avx512 -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512)
# Bit-identical arithmetic: no contraction, no value-changing optimisation. always_inline helpers and the
# kernel's text sit in one function, which -fno-trapping-math lets the compiler if-convert.
set(DVRLAB_MODULE_FLAGS -O3 -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-gnu-unique -fno-exceptions
    -fno-rtti -fvisibility=hidden -fno-semantic-interposition -Wno-psabi
    -Wno-unused-parameter # a kernel's text need not use all that its contract gives
    -Wno-maybe-uninitialized -Wno-uninitialized) # the last two: false alarms of g++ 12's own avx512 headers

# Sanitized kernel texts take minutes to compile; what they read is held to its bounds by guard pages (ctest kernel).
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  list(APPEND DVRLAB_MODULE_FLAGS -fno-sanitize=all)
endif()

# dvrlab_add_kernel_modules(kind name kernel_file output_folder [SUFFIX s] [FLAGS flag...]): sets
# DVRLAB_MODULE_TARGETS in the caller. SUFFIX tells the targets of a second set from the first, built with more FLAGS.
function(dvrlab_add_kernel_modules kind name kernel out)
  cmake_parse_arguments(ARG "" "SUFFIX" "FLAGS" ${ARGN})
  set(targets "")
  # Nothing is rendered by the fuzz programs, and g++'s vector types are not clang's.
  if(DVRLAB_FUZZ)
    if(NOT TARGET dvrlab_no_modules)
      add_custom_target(dvrlab_no_modules)
    endif()
    set(DVRLAB_MODULE_TARGETS dvrlab_no_modules PARENT_SCOPE)
    return()
  endif()
  set(has_voxels 0)
  set(walking 0)
  set(tetrahedra 0)
  set(has_cells 0)
  if(kernel)
    file(STRINGS ${kernel} voxel_words REGEX "VOXELS\\(")
    if(voxel_words)
      set(has_voxels 1)
    endif()
    # A sampler that defines sample_cell says where its value lies among its voxels, so that light can lie beside them.
    file(STRINGS ${kernel} cell_words REGEX "sample_cell\\(")
    if(cell_words)
      set(has_cells 1)
    endif()
    # A sampler that defines walk_next goes from face to face; the others are asked at positions (docs/adr/0001).
    file(STRINGS ${kernel} walk_words REGEX "walk_next\\(")
    if(walk_words)
      set(walking 1)
    endif()
    # One that speaks of a tetrahedra_walk gets the framework's (framework/kernel/tetrahedra.kernel).
    file(STRINGS ${kernel} tetrahedra_words REGEX "tetrahedra_walk")
    if(tetrahedra_words)
      set(tetrahedra 1)
    endif()
  endif()
  foreach(isa ${DVRLAB_ISAS} fp64)
    string(REPLACE "." "_" isa_id ${isa})
    set(target dvrlab_${kind}_${name}_${isa_id}${ARG_SUFFIX})
    add_library(${target} MODULE ${DVRLAB_ROOT}/framework/kernel/cpu/${kind}.module.cpp)
    target_include_directories(${target} PRIVATE ${DVRLAB_ROOT})
    target_compile_features(${target} PRIVATE cxx_std_20)
    target_compile_definitions(${target} PRIVATE DVR_KERNEL_FILE="${kernel}" DVR_KERNEL_NAME="${name}" DVR_ISA_${isa_id}=1 DVR_HAS_VOXELS=${has_voxels} DVR_HAS_CELLS=${has_cells} DVR_WALKING=${walking} DVR_TETRAHEDRA=${tetrahedra})
    target_compile_options(${target} PRIVATE ${DVRLAB_MODULE_FLAGS} ${DVRLAB_FLAGS_${isa}} ${ARG_FLAGS})
    target_link_libraries(${target} PRIVATE dvrlab_warnings)
    target_link_options(${target} PRIVATE -Wl,--version-script=${DVRLAB_ROOT}/framework/kernel/cpu/module.map -Wl,-z,defs)
    set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name}.${isa} LIBRARY_OUTPUT_DIRECTORY ${out}
                          CXX_EXTENSIONS OFF)
    list(APPEND targets ${target})
  endforeach()
  set(DVRLAB_MODULE_TARGETS ${targets} PARENT_SCOPE)
endfunction()

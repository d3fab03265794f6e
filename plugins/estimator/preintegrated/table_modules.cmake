# The builder of pre-integration tables: its modules, one per instruction set, and a library for tests and benchmarks.
include_guard(GLOBAL)

# dvrlab_add_table_modules(prefix folder): folder/table.<isa>.so, which BuildMeans::folder names at run time. Sets
# DVRLAB_TABLE_MODULE_TARGETS in the caller.
function(dvrlab_add_table_modules prefix folder)
  if(DVRLAB_FUZZ) # as for kernel modules: nothing is rendered there, and g++'s vector types are not clang's
    if(NOT TARGET dvrlab_no_modules)
      add_custom_target(dvrlab_no_modules)
    endif()
    set(DVRLAB_TABLE_MODULE_TARGETS dvrlab_no_modules PARENT_SCOPE)
    return()
  endif()
  set(targets "")
  foreach(isa ${DVRLAB_ISAS})
    string(REPLACE "." "_" isa_id ${isa})
    set(module ${prefix}_table_${isa_id})
    add_library(${module} MODULE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/table.module.cpp)
    target_include_directories(${module} PRIVATE ${DVRLAB_ROOT})
    target_compile_features(${module} PRIVATE cxx_std_20)
    target_compile_definitions(${module} PRIVATE DVR_ISA_${isa_id}=1)
    target_compile_options(${module} PRIVATE ${DVRLAB_MODULE_FLAGS} ${DVRLAB_FLAGS_${isa}})
    target_link_libraries(${module} PRIVATE dvrlab_warnings)
    target_link_options(${module} PRIVATE -Wl,--version-script=${CMAKE_CURRENT_FUNCTION_LIST_DIR}/table.map -Wl,-z,defs)
    set_target_properties(${module} PROPERTIES PREFIX "" OUTPUT_NAME table.${isa} LIBRARY_OUTPUT_DIRECTORY ${folder}
                          CXX_EXTENSIONS OFF)
    list(APPEND targets ${module})
  endforeach()
  set(DVRLAB_TABLE_MODULE_TARGETS ${targets} PARENT_SCOPE)
endfunction()

# The target dvrlab_table, once for the tests and the benchmark: DVRLAB_TABLE_MODULES is the folder of its modules.
function(dvrlab_table_library)
  if(TARGET dvrlab_table)
    return()
  endif()
  set(folder ${CMAKE_BINARY_DIR}/table_modules)
  dvrlab_add_table_modules(dvrlab ${folder})
  add_library(dvrlab_table STATIC ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/cells.cpp ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/table_request.cpp
              ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/table_inputs.cpp ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/table_library.cpp
              ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/table_build.cpp ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/definition.cpp
              ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/published.cpp ${DVRLAB_ROOT}/backends/cpu/isa.cpp)
  target_link_libraries(dvrlab_table PUBLIC dvrlab_core PRIVATE dvrlab_warnings ${CMAKE_DL_LIBS})
  target_compile_definitions(dvrlab_table INTERFACE DVRLAB_TABLE_MODULES="${folder}")
  add_dependencies(dvrlab_table ${DVRLAB_TABLE_MODULE_TARGETS})
endfunction()

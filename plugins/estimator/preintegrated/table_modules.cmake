# The builder of pre-integration tables as a library, and its modules, one per instruction set.
# dvrlab_add_table_library(target folder): a static library of this folder's table sources; folder/table.<isa>.so are
# the modules that it opens at run time (BuildMeans::folder). Call it once per folder.
include_guard(GLOBAL)
set(DVRLAB_TABLE_SOURCE ${CMAKE_CURRENT_LIST_DIR})

function(dvrlab_add_table_library target folder)
  add_library(${target} STATIC ${DVRLAB_TABLE_SOURCE}/cells.cpp ${DVRLAB_TABLE_SOURCE}/table_request.cpp
              ${DVRLAB_TABLE_SOURCE}/table_inputs.cpp ${DVRLAB_TABLE_SOURCE}/table_library.cpp
              ${DVRLAB_TABLE_SOURCE}/table_build.cpp ${DVRLAB_ROOT}/backends/cpu/isa.cpp)
  target_link_libraries(${target} PUBLIC dvrlab_core PRIVATE dvrlab_warnings ${CMAKE_DL_LIBS})
  foreach(isa ${DVRLAB_ISAS})
    string(REPLACE "." "_" isa_id ${isa})
    set(module ${target}_${isa_id})
    add_library(${module} MODULE ${DVRLAB_TABLE_SOURCE}/table.module.cpp)
    target_include_directories(${module} PRIVATE ${DVRLAB_ROOT})
    target_compile_definitions(${module} PRIVATE DVR_ISA_${isa_id}=1)
    target_compile_options(${module} PRIVATE ${DVRLAB_MODULE_FLAGS} ${DVRLAB_FLAGS_${isa}})
    target_link_libraries(${module} PRIVATE dvrlab_warnings)
    target_link_options(${module} PRIVATE -Wl,--version-script=${DVRLAB_TABLE_SOURCE}/table.map -Wl,-z,defs)
    set_target_properties(${module} PROPERTIES PREFIX "" OUTPUT_NAME table.${isa} LIBRARY_OUTPUT_DIRECTORY ${folder}
                          CXX_EXTENSIONS OFF)
    add_dependencies(${target} ${module})
  endforeach()
endfunction()

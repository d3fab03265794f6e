# The table builder's modules lie beside the plugin; its threads and the choice of the instruction set are those of the cpu
# backend.
include(${CMAKE_CURRENT_LIST_DIR}/table_modules.cmake)
dvrlab_add_table_modules(${DVRLAB_TARGET} ${out})
add_dependencies(${DVRLAB_TARGET} ${DVRLAB_TABLE_MODULE_TARGETS})
target_sources(${DVRLAB_TARGET} PRIVATE ${DVRLAB_ROOT}/backends/cpu/isa.cpp)
target_link_libraries(${DVRLAB_TARGET} PRIVATE ${CMAKE_DL_LIBS})

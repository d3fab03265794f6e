# Ray set-up and compositing are framework texts: a kernel module without a kernel file of its own, built once more
# here, so that this backend needs no other one.
dvrlab_add_kernel_modules(march march "" ${out} SUFFIX _${name})
add_dependencies(${DVRLAB_TARGET} ${DVRLAB_MODULE_TARGETS})
target_link_libraries(${DVRLAB_TARGET} PRIVATE ${CMAKE_DL_LIBS})

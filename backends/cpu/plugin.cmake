find_package(TBB CONFIG)
if(TARGET TBB::tbb)
  target_link_libraries(${DVRLAB_TARGET} PRIVATE TBB::tbb)
  # Ray set-up and compositing are framework texts: a kernel module without a kernel file of its own.
  dvrlab_add_kernel_modules(march march "" ${out})
  add_dependencies(${DVRLAB_TARGET} ${DVRLAB_MODULE_TARGETS})
else()
  set(DVRLAB_SKIP "oneTBB not found (Debian package libtbb-dev)")
endif()

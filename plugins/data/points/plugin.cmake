# Delaunay's tetrahedra: Qhull (Debian package libqhull-dev).
find_package(Qhull CONFIG QUIET)
if(TARGET Qhull::qhull_r)
  target_link_libraries(${DVRLAB_TARGET} PRIVATE Qhull::qhull_r)
else()
  set(DVRLAB_SKIP "Qhull is missing (Debian package libqhull-dev)")
endif()

# The shipped samples stand beside the plugin tree as they do in the source tree, so that the example works in both.
file(GLOB shipped CONFIGURE_DEPENDS ${dir}/../../../data/*.csv)
foreach(samples ${shipped})
  get_filename_component(samples_name ${samples} NAME)
  configure_file(${samples} ${ARG_OUTPUT}/../data/${samples_name} COPYONLY)
endforeach()

# Delaunay's tetrahedra: Qhull (Debian package libqhull-dev).
find_package(Qhull CONFIG QUIET)
if(TARGET Qhull::qhull_r)
  target_link_libraries(${DVRLAB_TARGET} PRIVATE Qhull::qhull_r)
else()
  set(DVRLAB_SKIP "Qhull is missing (Debian package libqhull-dev)")
endif()

dvrlab_ship(*.csv)

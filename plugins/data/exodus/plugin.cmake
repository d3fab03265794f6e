# Exodus II is a convention in netCDF (Debian package libnetcdf-dev). Its CMake package asks for HDF5's, so pkg-config is
# asked.
find_package(PkgConfig REQUIRED)
pkg_check_modules(netcdf QUIET IMPORTED_TARGET netcdf)
if(netcdf_FOUND)
  target_link_libraries(${DVRLAB_TARGET} PRIVATE PkgConfig::netcdf)
else()
  set(DVRLAB_SKIP "netCDF is missing (Debian package libnetcdf-dev)")
endif()

dvrlab_ship(*.exo)

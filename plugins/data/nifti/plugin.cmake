# nifticlib (Debian package libnifti-dev). Its CMake package names programs that another Debian package holds, so
# the library is looked for by file.
find_path(DVRLAB_NIFTI_INCLUDE nifti2_io.h PATH_SUFFIXES nifti)
find_library(DVRLAB_NIFTI_LIBRARY nifti2)
find_package(ZLIB)
if(DVRLAB_NIFTI_INCLUDE AND DVRLAB_NIFTI_LIBRARY AND ZLIB_FOUND)
  target_include_directories(${DVRLAB_TARGET} SYSTEM PRIVATE ${DVRLAB_NIFTI_INCLUDE})
  target_link_libraries(${DVRLAB_TARGET} PRIVATE ${DVRLAB_NIFTI_LIBRARY} ZLIB::ZLIB)
else()
  set(DVRLAB_SKIP "nifticlib is missing (Debian package libnifti-dev)")
endif()

dvrlab_ship(*.nii.gz)

# GDCM (Debian package libgdcm-dev). Its CMake package names programs that another Debian package holds, so the
# libraries are looked for by file.
find_path(DVRLAB_GDCM_INCLUDE gdcmImageReader.h PATH_SUFFIXES gdcm-3.0)
find_library(DVRLAB_GDCM_MSFF gdcmMSFF)
find_library(DVRLAB_GDCM_DSED gdcmDSED)
find_library(DVRLAB_GDCM_COMMON gdcmCommon)
if(DVRLAB_GDCM_INCLUDE AND DVRLAB_GDCM_MSFF AND DVRLAB_GDCM_DSED AND DVRLAB_GDCM_COMMON)
  target_include_directories(${DVRLAB_TARGET} SYSTEM PRIVATE ${DVRLAB_GDCM_INCLUDE})
  target_link_libraries(${DVRLAB_TARGET} PRIVATE ${DVRLAB_GDCM_MSFF} ${DVRLAB_GDCM_DSED} ${DVRLAB_GDCM_COMMON})
else()
  set(DVRLAB_SKIP "GDCM is missing (Debian package libgdcm-dev)")
endif()

dvrlab_ship(dicom_torus/*.dcm)

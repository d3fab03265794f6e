# The ABI tag: a number, the hash of the interface headers, the compiler's ABI. A plugin of another tag is refused
# with both tags. The header is generated at build time, so that an edited interface changes the tag.
set(DVRLAB_ABI_NUMBER 1)
set(DVRLAB_GENERATED ${CMAKE_BINARY_DIR}/generated)
file(GLOB DVRLAB_INTERFACE_HEADERS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/framework/interfaces/*.h)
add_custom_command(
  OUTPUT ${DVRLAB_GENERATED}/framework/interfaces/abi_tag.h
  COMMAND ${CMAKE_COMMAND} -DNUMBER=${DVRLAB_ABI_NUMBER} "-DHEADERS=${DVRLAB_INTERFACE_HEADERS}"
          "-DCOMPILER=${CMAKE_CXX_COMPILER_ID}-${CMAKE_CXX_COMPILER_VERSION}"
          -DOUTPUT=${DVRLAB_GENERATED}/framework/interfaces/abi_tag.h -P ${CMAKE_SOURCE_DIR}/cmake/write_abi_tag.cmake
  DEPENDS ${DVRLAB_INTERFACE_HEADERS} ${CMAKE_SOURCE_DIR}/cmake/write_abi_tag.cmake
  COMMENT "ABI tag" VERBATIM)
add_custom_target(dvrlab_abi_tag DEPENDS ${DVRLAB_GENERATED}/framework/interfaces/abi_tag.h)

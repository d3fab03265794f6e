get_property(missing GLOBAL PROPERTY DVRLAB_VTK_XML_MISSING)
if(missing)
  set(DVRLAB_SKIP "${missing}")
else()
  target_link_libraries(${DVRLAB_TARGET} PRIVATE dvrlab_vtk_xml)
endif()

# The shipped volumes stand beside the plugin tree as they do in the source tree, so that the example works in both.
file(GLOB shipped CONFIGURE_DEPENDS ${dir}/../../../data/*.vti)
foreach(volume ${shipped})
  get_filename_component(volume_name ${volume} NAME)
  configure_file(${volume} ${ARG_OUTPUT}/../data/${volume_name} COPYONLY)
endforeach()

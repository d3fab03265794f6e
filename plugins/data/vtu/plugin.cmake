get_property(missing GLOBAL PROPERTY DVRLAB_VTK_XML_MISSING)
if(missing)
  set(DVRLAB_SKIP "${missing}")
else()
  target_link_libraries(${DVRLAB_TARGET} PRIVATE dvrlab_vtk_xml)
endif()

# The shipped meshes stand beside the plugin tree as they do in the source tree, so that the example works in both.
file(GLOB shipped CONFIGURE_DEPENDS ${dir}/../../../data/*.vtu)
foreach(mesh ${shipped})
  get_filename_component(mesh_name ${mesh} NAME)
  configure_file(${mesh} ${ARG_OUTPUT}/../data/${mesh_name} COPYONLY)
endforeach()

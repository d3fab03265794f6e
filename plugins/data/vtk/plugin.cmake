# The shipped meshes stand beside the plugin tree as they do in the source tree, so that the example works in both.
file(GLOB shipped CONFIGURE_DEPENDS ${dir}/../../../data/*.vtk)
foreach(mesh ${shipped})
  get_filename_component(mesh_name ${mesh} NAME)
  configure_file(${mesh} ${ARG_OUTPUT}/../data/${mesh_name} COPYONLY)
endforeach()

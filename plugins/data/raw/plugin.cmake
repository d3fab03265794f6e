# The shipped volumes stand beside the plugin tree as they do in the source tree, so that the example works in both.
file(GLOB shipped CONFIGURE_DEPENDS ${dir}/../../../data/letter_f.*)
foreach(volume ${shipped})
  get_filename_component(volume_name ${volume} NAME)
  configure_file(${volume} ${ARG_OUTPUT}/../data/${volume_name} COPYONLY)
endforeach()

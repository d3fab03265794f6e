dvrlab_link_vtk_xml()
dvrlab_ship(*.vtu)

dvrlab_ship(*.vtk)

dvrlab_ship(*.nrrd)

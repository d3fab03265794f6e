dvrlab_ship(letter_f.*)

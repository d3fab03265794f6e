# The example's volume lies beside it. A library that a reader needs is found and linked here, too; what is missing
# is said in DVRLAB_SKIP, with its Debian package.
configure_file(${dir}/${name}.txt ${out}/${name}.txt COPYONLY)

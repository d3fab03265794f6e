# One set of warnings for all of our code.
add_library(dvrlab_warnings INTERFACE)
target_compile_options(dvrlab_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow=local -Wnon-virtual-dtor -Wold-style-cast
                       $<$<BOOL:${DVRLAB_WERROR}>:-Werror>)

# One set of warnings for all of our code.
add_library(dvrlab_warnings INTERFACE)
target_compile_options(dvrlab_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow=local -Wnon-virtual-dtor -Wold-style-cast
                       # g++ 12 reports overlaps in std::string concatenation that are not there (GCC bug 105651)
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
                       $<$<BOOL:${DVRLAB_WERROR}>:-Werror>)

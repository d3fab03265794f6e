// The type `spectral` of a kernel variant: RGB or grey extinction (not guarded: included once per variant).
#if DVR_RGB
typedef dvr::vec3r spectral;
#else
typedef dvr::real spectral;
#endif
using real = dvr::real;
using inti = dvr::inti;
using mask = dvr::mask;
using vec3r = dvr::vec3r;
using vec4r = dvr::vec4r;
using cell8 = dvr::cell8;

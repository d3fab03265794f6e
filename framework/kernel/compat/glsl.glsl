// The kernel language as GLSL 4.5. Only words: every function of the language lives in *.kernel texts.
#define real float
#define inti int
#define mask bool
#define vec3r vec3
#define vec4r vec4
#define vec4i ivec4
#if DVR_RGB
#define spectral vec3
#else
#define spectral float
#endif

#define KFN
#define OUT(type) out type
#define INOUT(type) inout type
#define R(x) float(x)
#define I(x) int(x)
#define V3(u) ((u).xyz)
#define v3(x, y, z) vec3(x, y, z)
#define xyz(v) ((v).xyz)

// Uniforms and buffers are declared by the generated blocks, with the fetch functions of each buffer.
#define UNIFORM_F(name)
#define UNIFORM_I(name)
#define UNIFORM_V(name)
#define TABLE4(name)
#define TABLEI(name)
#define TABLEI4(name)
#define ENTRY(name)
#define BYTES(name)
#define VOXELS(name) DVR_DEFINE_FETCH_CELL(name)
#define VOLUME(name) DVR_DEFINE_FETCH_CELL(name)
#define LEVELS(name) DVR_DEFINE_FETCH_CELL(name)

#define fetch1(name, i) fetch1_##name(uint(i))
#define fetch2(name, i, a, b) fetch2_##name(uint(i), a, b)
#define fetch4(name, i) fetch4_##name(i)
#define fetch4u(name, i) fetch4_##name(i)
#define fetchi(name, i) fetchi_##name(i)
#define fetchi4(name, i) fetchi4_##name(i)
#define entry_next(name, f, o, d, e, on) entry_next_##name(f, o, d, e)
#define fetch4_affine(name, i, w) (fetch4_##name(2 * (i)) + fetch4_##name(2 * (i) + 1) * (w))

struct cell8 { float v000, v100, v010, v110, v001, v101, v011, v111; };
#define fetch_cell(name, base, dy, dz) fetch_cell_##name(base, dy, dz)
#define DVR_DEFINE_FETCH_CELL(name)                                  \
  cell8 fetch_cell_##name(int base, int dy, int dz) {                \
    cell8 r;                                                         \
    fetch2_##name(uint(base), r.v000, r.v100);                       \
    fetch2_##name(uint(base) + uint(dy), r.v010, r.v110);            \
    fetch2_##name(uint(base) + uint(dz), r.v001, r.v101);            \
    fetch2_##name(uint(base) + uint(dz) + uint(dy), r.v011, r.v111); \
    return r;                                                        \
  }

bool any_lane(bool m) { return m; }
bool all_lanes(bool m) { return m; }
float select(bool m, float a, float b) { return m ? a : b; }
int select(bool m, int a, int b) { return m ? a : b; }
vec3 select(bool m, vec3 a, vec3 b) { return m ? a : b; }
vec4 select(bool m, vec4 a, vec4 b) { return m ? a : b; }
float rmin(float a, float b) { return b < a ? b : a; }
float rmax(float a, float b) { return a < b ? b : a; }
int imin(int a, int b) { return b < a ? b : a; }
int imax(int a, int b) { return a < b ? b : a; }
int to_int(float a) { return int(a); }
float to_real(int a) { return float(a); }
int as_int(float a) { return floatBitsToInt(a); }
float as_real(int a) { return intBitsToFloat(a); }
float rabs(float a) { return intBitsToFloat(floatBitsToInt(a) & 0x7fffffff); }
int shl(int a, int n) { return a << n; }
int shr(int a, int n) { return int(uint(a) >> uint(n)); }

// Built-in names that the kernels define themselves.
#define exp dvr_exp
#define sqrt dvr_sqrt

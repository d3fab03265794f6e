#!/usr/bin/env python3
"""Negative control of the kernel lint: each planted offence must be caught by its rule, and by no other; the clean
text, which uses every word of the subset next to look-alikes in comments, must pass."""
import sys

sys.dont_write_bytecode = True

import kernel_lint

CLEAN = """\
// Division a / b, pow(x, y), 1.0 and x ? y : z in comments are fine. /* inversesqrt(x) */
UNIFORM_F(demo_scale)
UNIFORM_I(demo_count)
#define SHIFT I(3)
#if DVR_RGB
KFN spectral twice(spectral x) { return x * R(2.0); }
#else
KFN spectral twice(spectral x) { return x * R(2.0e0); }
#endif
struct pair { real length; real mix; vec3r b; };
KFN real demo(real x, int n, OUT(real) y) {
  pair p;
  p.length = R(-1.5e-3) * x + R(demo_scale);
  p.b = v3(x, x, R(.5));
  p.b.x = as_real(I(0x7ef311c3) - as_int(x));
  y = sqrt(rmax(x, R(1.1754944e-38))) * exp(-x) * rcp(x) * floor(x);
  for (int k = 0; k < n; ++k) y = y + to_real(I(k) + SHIFT);
  for (int s = demo_count; s > 0; s >>= 1) {
    if ((s & 1) != 0 && demo_scale > 0.5) y = y * y;
  }
  mask more = x > R(0.0);
  while (any_lane(more)) {
    x = select(more, x - R(1.0), x);
    more = x > R(0.0);
  }
  if (any_lane(x > R(2.0)) || all_lanes(x < R(1.0))) y = select(x > R(2.0), R(0.0), y);
  return p.length;
}
"""

# rule -> lines that must each be caught when they stand in a function of real x, vec3r v, inti j, int n
PLANTED = {
    "division": ["x = x / R(3.0);", "x /= R(3.0);", "x = R(1.0) / (x);", "j = j / I(2);"],
    "builtin": ["x = inversesqrt(x);", "x = dot(v, v);", "x = length(v);", "v = normalize(v);", "v = mix(v, v, x);",
                "x = pow(x, x);", "x = fma(x, x, x);", "x = smoothstep(x, x, x);", "x = v.length();", "x = sin (x);",
                "x = log(x);", "x = distance(v, v);"],
    "ternary": ["x = x > R(0.0) ? x : x;", "n = n > 0 ? 1 : 2;"],
    "swizzle": ["v.xy = v.yx;", "v.xyz = v;", "v.rgb += v;", "x = dot3(v.zyx, v);"],
    "literal": ["x = 1.0;", "x = x * 2.0f;", "x = x + 1e-3;", "x = R(1.0 + 2.0);", "x = R(demo_scale * 0.5);",
                "v = v3(0.5, x, x);", "x = rmax(x, .5);", "if (demo_scale > 0.1) x = x;", "x = R(x, 1.0);"],
    "type": ["double y;", "float y = x;", "vec3 y = v;", "mat3 m;", "mat4x3 m;", "dvec2 y;", "matrix m;"],
    "infinity": ["x = R(INFINITY);", "x = infinity;", "x = HUGE_VALF;", "x = uintBitsToFloat(0x7f800000);", "x = NAN;"],
    "directive": ["#ifdef __cplusplus\n#endif", "#if GL_ES\n#endif", "#if defined(__AVX512F__)\n#endif", "#include \"x\"",
                  "#version 450", "#  if !defined(GL_core_profile)\n#endif", "#if DVR_RGB && __GNUC__\n#endif",
                  "#pragma unroll"],
    "control": ["while (x > R(0.0)) x = x - R(1.0);", "for (inti k = I(0); k < j; k = k + I(1)) x = x;",
                "if (x > R(0.0)) x = x;", "do { x = x; } while (x > R(0.0));", "while (any_lane(x > R(0.0)) && x > R(1.0)) x = x;",
                "for (int k = 0; to_real(I(k)) < x; ++k) x = x;"],
    "reserved": ["mask flat = x > R(0.0);", "real sample = x;", "real new = x;", "mask not = x > R(1.0);",
                 "static real y;"],
}
TOP_LEVEL = {"inline": ["real outlined(real x) { return x; }", "UNIFORM_I(demo_more) void outlined() { }"]}
FRAME = "UNIFORM_F(demo_scale)\nKFN real planted(real x, vec3r v, inti j, int n) {\n%s\n  return x;\n}\n"


def main():
    failures = []
    found = kernel_lint.lint(CLEAN)
    if found:
        failures.append(f"the clean text was refused: {found}")
    if kernel_lint.lint(FRAME % ""):
        failures.append("the frame of the planted offences is not clean")
    planted = 0
    for cases, frame in ((PLANTED, FRAME), (TOP_LEVEL, "%s\n")):
        for rule, lines in cases.items():
            for line in lines:
                planted += 1
                rules = {o[2] for o in kernel_lint.lint(frame % line)}
                if rules != {rule}:
                    failures.append(f"planted [{rule}] {line!r}: reported as {sorted(rules) or 'clean'}")
    for rule in kernel_lint.RULES:
        if rule not in PLANTED and rule not in TOP_LEVEL:
            failures.append(f"the rule [{rule}] has no planted offence")
    # The place must be right: line 3 of the framed text, the column of the slash.
    if kernel_lint.lint(FRAME % "x = x / x;")[0][:2] != (3, 7):
        failures.append("the place of an offence is wrong")
    for failure in failures:
        print(failure)
    print(f"kernel lint self-test: {planted} planted offences, {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

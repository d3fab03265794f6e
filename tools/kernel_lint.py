#!/usr/bin/env python3
"""Kernel lint: holds every *.kernel text to the kernel subset, the language that is C++ and GLSL at once.

  kernel_lint.py               all kernel texts of the repository, and the share of neutral code
  kernel_lint.py FILE...       these texts only (uniforms of the framework's kernels are known)

Each offence is one line: file:line:column: [rule] what was found and what to write instead. Exit code 1 if any.
The rules are the keys of RULES; tools/kernel_lint_selftest.py plants one offence for each.
"""
import re
import struct
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NEUTRAL_SHARE = 0.85

RULES = {
    "division": "division differs between devices; multiply by rcp(x)",
    "builtin": "a language's own function has no stated bits; use the words of framework/kernel/math.kernel",
    "ternary": "lanes do not branch; use select(mask, a, b)",
    "swizzle": "no swizzles in C++; name components, or use xyz() and v3()",
    "literal": "float literals are written R(literal); bare ones only in uniform conditions, and exact in fp32",
    "type": "use the words real, inti, mask, vec3r, vec4r, spectral; no double, no matrices",
    "infinity": "no infinities and NaNs in kernels; opaque means T = 0",
    "directive": "only feature variants (#if DVR_RGB, DVR_FULL) and #define; language switches live in compat headers",
    "control": "conditions are uniform (uniforms, int, bool) or made of any_lane() and all_lanes()",
    "reserved": "the word means something in GLSL or in C++; take another name",
    "inline": "functions start with KFN: an outlined one is slow and silent about it",
}

FEATURES = {"DVR_RGB", "DVR_FULL"}
BUILTINS = set(
    """inversesqrt dot length distance normalize reflect refract faceforward cross mix pow fma mad smoothstep
    mod fmod fract modf sin cos tan asin acos atan atan2 sinh cosh tanh log log10 log1p expm1 ldexp frexp cbrt
    matrixCompMult outerProduct transpose determinant inverse dFdx dFdy fwidth texture texelFetch textureLod
    sqrtf expf powf fmaf""".split())
TYPES = re.compile(r"^(float|double|half|float16_t|float32_t|float64_t|[dibu]?vec[234]|d?mat[234](x[234])?|uint|long|matrix)$")
INFINITIES = re.compile(r"^(inf|infinity|INFINITY|HUGE_VALF?|HUGE_VAL|nan|NAN|isinf|isnan|uintBitsToFloat)$")
RESERVED = set(
    # GLSL: qualifiers and words kept for later
    """attribute varying uniform buffer shared coherent volatile restrict readonly writeonly layout centroid flat smooth
    noperspective patch sample subroutine in out inout invariant precise discard lowp mediump highp precision common
    partition active filter input output resource packed row_major noise superp fixed unsigned asm cast sampler1D
    sampler2D sampler3D image2D image3D atomic_uint hvec2 hvec3 hvec4 fvec2 fvec3 fvec4
    """.split() +
    # C++
    """alignas alignof and and_eq auto bitand bitor case catch char class compl concept const_cast consteval constexpr
    constinit decltype default delete dynamic_cast enum explicit export extern friend inline mutable namespace new
    noexcept not not_eq nullptr operator or or_eq private protected public register reinterpret_cast requires short
    signed sizeof static static_assert static_cast template this thread_local throw try typedef typeid typename union
    using virtual wchar_t xor xor_eq""".split())
SWIZZLE = re.compile(r"^([xyzw]{2,4}|[rgba]{2,4}|[stpq]{2,4})$")
FLOAT = r"(?:\d+\.\d*|\.\d+)(?:[eE][+-]?\d+)?[fF]?|\d+[eE][+-]?\d+[fF]?"
TOKEN = re.compile(rf"(?P<hex>0[xX][0-9a-fA-F]+[uU]?)|(?P<float>{FLOAT})|(?P<int>\d+[uU]?)|(?P<name>[A-Za-z_]\w*)"
                   r"|(?P<op>[-+*/%&|^<>=!]=|<<=?|>>=?|&&|\|\||\+\+|--|##|[^\s\w])")
UNIFORM = re.compile(r"\bUNIFORM(?:_\w+)?\s*\(\s*(?:\w+\s*,\s*)?(\w+)\s*\)")
SCALAR = re.compile(r"\b(?:int|bool)\s+(\w+)")


def without_comments(text):
    """The text with comments turned into blanks, so that places stay."""
    blank = lambda m: re.sub(r"[^\n]", " ", m.group())
    return re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.S)


class Token:
    def __init__(self, kind, text, offset):
        self.kind, self.text, self.offset = kind, text, offset


def tokens_of(text):
    return [Token(m.lastgroup, m.group(), m.start()) for m in TOKEN.finditer(text)]


def exact_in_fp32(literal):
    value = float(literal.rstrip("fF"))
    try:
        return struct.unpack("f", struct.pack("f", value))[0] == value
    except OverflowError:
        return False


def closing(tokens, i):
    """Index of the parenthesis that closes the one at i."""
    depth = 0
    for j in range(i, len(tokens)):
        depth += {"(": 1, ")": -1}.get(tokens[j].text, 0)
        if depth == 0:
            return j
    return len(tokens) - 1


def uniform_condition(tokens, uniform):
    """True if the condition is the same for all lanes: any_lane(...), all_lanes(...) and uniform names."""
    i = 0
    while i < len(tokens):
        token = tokens[i]
        if token.text in ("any_lane", "all_lanes") and i + 1 < len(tokens) and tokens[i + 1].text == "(":
            i = closing(tokens, i + 1) + 1
            continue
        if token.kind == "name" and token.text not in uniform and token.text not in ("true", "false", "int", "bool"):
            return False
        i += 1
    return True


def lint(text, known_uniforms=()):
    """Offences of one kernel text: a list of (line, column, rule, found)."""
    source = without_comments(text)
    offences = []

    def report(offset, rule, found):
        line = source.count("\n", 0, offset) + 1
        offences.append((line, offset - source.rfind("\n", 0, offset), rule, found))

    # Directives: the feature variants and #define. The bodies of #define stay in the text and are linted.
    def directive(match):
        word, rest = match.group(1), match.group(2)
        if word in ("if", "ifdef", "ifndef", "elif"):
            if not all(n in FEATURES or n == "defined" for n in re.findall(r"[A-Za-z_]\w*", rest)):
                report(match.start(), "directive", match.group().strip())
        elif word == "define":
            return " " * (match.start(2) - match.start()) + match.group(2)
        elif word not in ("else", "endif", "undef"):
            report(match.start(), "directive", match.group().strip())
        return re.sub(r"[^\n]", " ", match.group())

    body = re.sub(r"^[ \t]*#[ \t]*(\w+)((?:[^\n]*\\\n)*[^\n]*)", directive, source, flags=re.M)
    tokens = tokens_of(body)
    uniform = set(known_uniforms) | set(UNIFORM.findall(body)) | set(SCALAR.findall(body)) | FEATURES
    in_condition = set()  # indices of tokens of uniform conditions
    calls = []            # names before the open parentheses
    braces, statement = 0, 0
    for i, token in enumerate(tokens):
        before = tokens[i - 1].text if i > 0 else ""
        after = tokens[i + 1].text if i + 1 < len(tokens) else ""
        t = token.text
        if t in ("/", "/="):
            report(token.offset, "division", t)
        elif t == "?":
            report(token.offset, "ternary", t)
        elif t == "(":
            calls.append(before)
        elif t == ")" and calls:
            calls.pop()
        elif t in ("{", "}", ";"):
            if t == "{" and braces == 0 and before == ")" and all(k.text != "KFN" for k in tokens[statement:i]):
                report(tokens[statement].offset, "inline", tokens[statement].text)
            braces += {"{": 1, "}": -1}.get(t, 0)
            statement = i + 1
        elif token.kind == "float":
            lone = after == ")" and (before == "(" or (before == "-" and tokens[i - 2].text == "("))
            if not (lone and calls and calls[-1] == "R") and not (i in in_condition and exact_in_fp32(t)):
                report(token.offset, "literal", t)
        elif token.kind == "name":
            if before == "." and SWIZZLE.match(t):
                report(token.offset, "swizzle", "." + t)
            elif t in BUILTINS and after == "(":
                report(token.offset, "builtin", t)
            elif TYPES.match(t):
                report(token.offset, "type", t)
            elif INFINITIES.match(t) and before != ".":
                report(token.offset, "infinity", t)
            elif t in RESERVED:
                report(token.offset, "reserved", t)
            elif t == "goto" or t == "switch":
                report(token.offset, "control", t)
            elif t in ("if", "while", "for") and after == "(":
                end = closing(tokens, i + 1)
                condition = range(i + 2, end)
                if t == "for":
                    semicolons = [k for k in condition if tokens[k].text == ";"]
                    condition = range(semicolons[0] + 1, semicolons[1]) if len(semicolons) == 2 else condition
                if uniform_condition([tokens[k] for k in condition], uniform):
                    in_condition.update(condition)
                else:
                    report(token.offset, "control", t + " (" + " ".join(tokens[k].text for k in condition) + ")")
    return sorted(offences)


def lines_of_code(path):
    return sum(1 for line in without_comments(path.read_text()).splitlines() if line.strip())


def neutral_share(root):
    """(neutral lines, language lines): kernel texts against the compat headers and the marches of each language."""
    kernel_folder = root / "framework" / "kernel"
    language = [*kernel_folder.glob("*.glsl"), *kernel_folder.glob("compat/*")]
    return (sum(lines_of_code(p) for p in kernel_texts(root)), sum(lines_of_code(p) for p in language if p.is_file()))


def kernel_texts(root):
    return sorted(p for top in ("framework", "plugins", "backends", "tests") for p in (root / top).rglob("*.kernel"))


def main(arguments):
    framework = sorted((ROOT / "framework").rglob("*.kernel"))
    texts = [Path(a) for a in arguments] or kernel_texts(ROOT)
    known = set()
    for path in framework:
        known |= set(UNIFORM.findall(without_comments(path.read_text())))
    bad = 0
    for path in texts:
        for line, column, rule, found in lint(path.read_text(), known):
            bad += 1
            print(f"{path}:{line}:{column}: [{rule}] {found}: {RULES[rule]}")
    print(f"kernel lint: {len(texts)} texts, {bad} offences")
    if not arguments:
        neutral, language = neutral_share(ROOT)
        share = neutral / max(neutral + language, 1)
        print(f"kernel lint: neutral share {100 * share:.1f} % ({neutral} lines of kernel texts, {language} of one "
              f"language only; more than {100 * NEUTRAL_SHARE:.0f} % wanted)")
        bad += share <= NEUTRAL_SHARE
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

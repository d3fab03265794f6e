#include "framework/config/sections.h"

#include <algorithm>
#include <cmath>

#include "framework/config/check_value.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

/// A mesh, and an estimator that steps matter to.
constexpr const char* faces_patch = R"({"data":{"evaluate":"mesh","size":[5,5,5]},"estimator":{"type":"average"}})";
// The default step is longer than any segment of this mesh; a unit shows with a shorter one.
constexpr const char* faces_unit_patch =
    R"({"data":{"evaluate":"mesh","size":[5,5,5]},"estimator":{"type":"average"},"sampling":{"step":0.3}})";

using Value = nlohmann::json;
using enum ParameterType;

bool numbers(const Value& v, std::size_t count) {
  return v.is_array() && v.size() == count &&
         std::all_of(v.begin(), v.end(), [](const Value& x) { return x.is_number(); });
}

bool null_or_range(const Value& v) { return v.is_null() || (numbers(v, 2) && v[0].get<double>() < v[1].get<double>()); }
bool null_or_number(const Value& v) { return v.is_null() || v.is_number(); }
bool null_or_range_or_equal(const Value& v) {
  return v.is_null() || (numbers(v, 2) && v[0].get<double>() <= v[1].get<double>());
}
bool null_or_bytes(const Value& v) { return v.is_null() || (v.is_number() && v.get<double>() >= 1); }
bool section(const Value& v) { return v.is_object(); }

bool ray_interval(const Value& v) {
  if (!v.is_array() || v.size() != 2 || !v[0].is_number() || v[0].get<double>() < 0) return false;
  return v[1].is_null() || (v[1].is_number() && v[1].get<double>() > v[0].get<double>());
}

bool whole(const Value& v) { return v.is_number() && v.get<double>() == std::floor(v.get<double>()); }

bool image_size(const Value& v) {
  return v.is_array() && v.size() == 2 && std::all_of(v.begin(), v.end(), [](const Value& x) {
           return whole(x) && x.get<double>() >= 1 && x.get<double>() <= 16384;
         });
}

bool only_keys(const Value& v, std::initializer_list<const char*> legal) {
  return std::all_of(v.items().begin(), v.items().end(), [&](const auto& item) {
    return std::any_of(legal.begin(), legal.end(), [&](const char* key) { return item.key() == key; });
  });
}

bool order(const Value& v) {
  if (v.is_null()) return true;
  return v.is_object() && only_keys(v, {"by", "is", "values"}) && v.contains("by") && v["by"].is_string() &&
         v.contains("is") && (v["is"] == "increasing" || v["is"] == "decreasing") &&
         (!v.contains("values") || (v["values"].is_array() && v["values"].size() > 1));
}

bool affine(const Value& v) {
  if (v.is_null()) return true;
  return v.is_object() && only_keys(v, {"by", "power", "within"}) && v.contains("by") && v["by"].is_string() &&
         v.contains("within") && v["within"].is_number() && v["within"].get<double>() >= 0 &&
         (!v.contains("power") || v["power"].is_number());
}

bool tf_domain_range(const Value& v) { return v == "data" || v == "type" || (null_or_range(v) && !v.is_null()); }
bool view(const Value& v) { return v.is_null() || (whole(v) && v.get<double>() >= 0 && v.get<double>() < 1e9); }

void check_orbit(const ParameterSet& p) {
  if (p.is_null("view") || p.json("view").get<long long>() < p.integer("views")) return;
  throw InputError(p.path_of("view") + ": found " + p.json("view").dump() + "; the orbit has views 0 to " +
                   std::to_string(p.integer("views") - 1) + ", and null stands for all of them");
}

constexpr Affects pixels = Affects::pixels, speed = Affects::speed, nothing = Affects::nothing;

const Parameter camera_frame{
    "frame",
    choice,
    "",
    "\"data\"",
    "data|world",
    "Coordinates of positions and lengths: the data's box (origin at its centre, unit = half its diagonal) or world.",
    pixels,
    "",
    "\"world\""};
const Parameter world_frame{
    "frame",      choice,
    "",           "\"world\"",
    "world|data", "Coordinates: world, or the data's box (origin at its centre, unit = half its diagonal).",
    pixels,       "",
    "\"data\""};
const Parameter light_frame{"frame",
                            choice,
                            "",
                            "\"world\"",
                            "world|data|camera",
                            "Coordinates: world, the data's box, or the camera's (x right, y up, z towards the eye, "
                            "origin at the eye, unit as the camera's frame).",
                            pixels,
                            R"({"camera":{"position":[1.2,-2.0,0.9]}})",
                            "\"camera\""};
const Parameter light_color{"color", vector3, "",           "[1,1,1]", "[0,inf)", "Colour of the light.",
                            pixels,  "",      "[0.3,0.6,1]"};
const Parameter camera_position{"position", vector3, "frame units", nullptr, "", "Where the camera stands.",
                                pixels,     "",      "[2,1,1]"};
const Parameter camera_target{"target", vector3, "frame units", "[0,0,0]", "", "What the camera looks at.",
                              pixels,   "",      "[0.2,0,0]"};
const Parameter camera_up{"up",   vector3, "",       "[0,0,1]", "", "The direction that is up in the image.",
                          pixels, "",      "[0,1,0]"};

std::vector<SectionType> declare() {
  return {
      {"case",
       "",
       "Keys at the top of a config.",
       {{"name", text, "", "\"\"", "", "Name of the experiment and of its folder; empty: the file's name.", nothing},
        {"schema", integer, "", "1", "[1,1]", "Version of the config language.", nothing},
        {"precision", choice, "", "\"strict\"", "strict|fast|fp64",
         "Strict: same bits on every backend and instruction set; fast: contraction is allowed; fp64: in double (cpu).",
         pixels, R"({"backend":{"type":"vulkan"}})", "\"fast\""},
        {"seed", integer, "", "0", "[0,4294967295]", "Seed of everything random (jitter).", pixels,
         R"({"sampling":{"jitter":1}})", "7"},
        {"panel", text, "", "\"\"", "", "What a figure calls the case, e.g. a; for people and for `where`.", nothing},
        {"repeat", integer, "", "1", "[1,1000]", "Number of timed renders of each case.", nothing},
        {"warmup", integer, "", "0", "[0,1000]", "Number of renders before the timed ones.", nothing},
        {"base_folder", text, "", "\"\"", "", "Where relative paths start, itself relative to the config's folder.",
         nothing}}},
      {"data",
       "",
       "Keys that all data plugins share.",
       {{"nan_policy", choice, "", "\"error\"", "error|replace", "What happens to values that are not finite.", pixels,
         "", "\"replace\""},
        {"nan_value", number, "physical value", "0", "", "Replacement under nan_policy replace.", pixels,
         R"({"data":{"nan_policy":"replace"}})", "0.7"},
        {"optional", boolean, "", "false", "", "Missing data is the verdict 'not supported' instead of an error.",
         nothing},
        {"reconstruction", choice, "", "\"exact\"", "exact",
         "Interpolation between grid points: trilinear in fp32 by our own code.", pixels},
        {"gradient", choice, "", "\"on_the_fly\"", "on_the_fly",
         "Where gradients come from: computed at every sample that needs one.", speed}}},
      {"optical_model",
       "",
       "Keys that all optical models share.",
       {{"tf", choice, "", "\"table\"", "table|nodes",
         "How kernels read the medium: a table that is linear between entries, or its exact nodes.", pixels, "",
         "\"nodes\""},
        {"tf_entries", integer, "", "4096", "[2,65536]", "Number of entries of the table.", pixels, "", "64"},
        {"tf_range", json, "physical value", "null", "null (the data's stored range) or [lo, hi] with lo < hi",
         "Values that the table spans: physical, whatever tf_domain is.", pixels, "", "[0.1,0.6]", "",
         R"({"type":["array","null"],"minItems":2,"maxItems":2,"items":{"type":"number"}})"},
        {"tf_domain", choice, "", "\"physical\"", "physical|normalized|quantized",
         "Unit of the model's values: physical, 0 to 1, or 0 to 2^tf_bits - 1 over tf_domain_range.", pixels, "",
         "\"normalized\""},
        {"tf_bits", integer, "bit", "8", "[1,16]", "Bits of quantized transfer function values.", pixels,
         R"({"optical_model":{"tf_domain":"quantized"}})", "4", "tf_domain=quantized"},
        {"tf_domain_range", json, "physical value", "\"data\"",
         "\"data\" (smallest and largest value of the data), \"type\" (of its integer voxel type) or [lo, hi] with "
         "lo < hi",
         "Physical values that normalized and quantized transfer functions are spread over.", pixels,
         R"({"optical_model":{"tf_domain":"normalized"}})", "[0,2]", "tf_domain=normalized|quantized",
         R"({"anyOf":[{"enum":["data","type"]},{"type":"array","minItems":2,"maxItems":2,"items":{"type":"number"}}]})"},
        {"interpolation", choice, "", "\"extinction\"", "extinction|opacity",
         "What is linear between transfer function nodes.", pixels, "", "\"opacity\""},
        {"opaque", choice, "", "\"interval\"", "interval|dirac|cap",
         "What fully opaque entries become: an opaque range of values, one table bin wide for an isolated entry; an "
         "opaque isosurface for an isolated entry; or a capped extinction.",
         pixels, R"({"optical_model":{"opacity":[[0.3,0],[0.5,1],[0.7,1],[0.9,0.2]]}})", "\"cap\""},
        {"length_unit", choice, "", "\"world\"", "world|voxel",
         "Unit of the model's lengths and extinctions; voxel: the smallest spacing.", pixels, "", "\"voxel\""}},
       {{"tf_range", null_or_range}, {"tf_domain_range", tf_domain_range}}},
      {"lights", "head", "A light at the eye: it shines along each ray.", {light_color}},
      {"lights",
       "directional",
       "A light that is infinitely far away.",
       {light_frame,
        {"direction", vector3, "", nullptr, "", "Direction towards the light.", pixels, "", "[0,1,0]"},
        light_color}},
      {"lights",
       "point",
       "A light at a point, without falloff.",
       {light_frame,
        {"position", vector3, "frame units", nullptr, "", "Where the light is.", pixels, "", "[0,2,3]"},
        light_color}},
      {"camera",
       "perspective",
       "A pinhole camera.",
       {camera_frame,
        camera_position,
        camera_target,
        camera_up,
        {"fov_deg", number, "degree", "30", "(0,180)", "Vertical field of view.", pixels, "", "45"}}},
      {"camera",
       "orthographic",
       "Parallel rays.",
       {camera_frame,
        camera_position,
        camera_target,
        camera_up,
        {"height", number, "frame units", "2", "(0,inf)",
         "Height of the image; 2 in the data frame holds the whole box.", pixels, "", "1"}}},
      {"camera",
       "orbit",
       "Views from a circle or a sphere around a target; each view is a case of its own.",
       {camera_frame,
        camera_target,
        {"path", choice, "", "\"circle\"", "circle|sphere",
         "Circle: equal angles about the axis; sphere: directions spread evenly (Fibonacci lattice).", pixels, "",
         "\"sphere\""},
        {"axis", vector3, "", "[0,0,1]", "", "Axis of the orbit, up in the image; any length but 0.", pixels, "",
         "[0,1,1]"},
        {"distance", number, "frame units", "4", "(0,inf)",
         "From the target to the eye; 4 in the data frame with 30 degrees shows the whole box.", pixels, "", "3"},
        {"elevation_deg", number, "degree", "20", "(-90,90)", "Height of the circle above the target's plane.", pixels,
         "", "-35", "path=circle"},
        {"start_deg", number, "degree", "0", "",
         "Angle of view 0 about the axis, from the direction of x (of y where the axis is x).", pixels, "", "25"},
        {"views", integer, "", "8", "[1,10000]", "Number of views.", pixels, R"({"camera":{"view":1}})", "5"},
        {"view", json, "", "null", "null (all views, each a case) or a whole number in [0, views-1]",
         "The view that a case shows.", pixels, R"({"camera":{"view":1}})", "2", "",
         R"({"type":["integer","null"],"minimum":0})"},
        {"projection", choice, "", "\"perspective\"", "perspective|orthographic", "Kind of the camera.", pixels, "",
         "\"orthographic\""},
        {"fov_deg", number, "degree", "30", "(0,180)", "Vertical field of view.", pixels, "", "20",
         "projection=perspective"},
        {"height", number, "frame units", "2", "(0,inf)", "Height of the image.", pixels,
         R"({"camera":{"projection":"orthographic"}})", "1.5", "projection=orthographic"}},
       {{"view", view}},
       check_orbit},
      {"camera",
       "ray",
       "Every pixel is the same ray.",
       {camera_frame,
        {"origin", vector3, "frame units", nullptr, "", "Where the ray starts.", pixels, "", "[-2,0.3,0.1]"},
        {"direction", vector3, "", nullptr, "", "Where it goes; any length but 0.", pixels, "", "[1,0,0.2]"},
        {"t", json, "frame units", "[0,null]", "[t0, t1] with 0 <= t0 < t1; t1 null: without end",
         "The part of the ray that is integrated, as arc length from the origin.", pixels, "", "[0,1.9]", "",
         R"({"type":"array","items":[{"type":"number","minimum":0},{"type":["number","null"]}],"minItems":2,"maxItems":2})"}},
       {{"t", ray_interval}}},
      {"clip",
       "",
       "A plane that keeps the points x with dot(normal, x) <= offset.",
       {world_frame,
        {"normal", vector3, "", nullptr, "", "Points to the side that is cut away; any length but 0.", pixels, "",
         "[1,0,0]"},
        {"offset", number, "frame units", "0", "", "Keeps dot(normal, x) <= offset, normal scaled to length 1.", pixels,
         "", "-0.4"},
        {"clip_normal", choice, "", "\"data\"", "data|plane",
         "Normal that lights the matter just under the plane: the data's gradient, or the plane's normal (Weiskopf et "
         "al. 2003).",
         pixels, "", "\"plane\""},
        {"clip_depth", number, "voxel", "2", "(0,inf)",
         "Depth at which the plane's normal has given way to the data's, linearly; voxel: the smallest spacing.",
         pixels, R"({"clip":{"clip_normal":"plane"}})", "6", "clip_normal=plane"}}},
      {"sampling",
       "uniform",
       "Samples at equal distances from the entry point.",
       {{"step", number, "see unit", "1", "(0,inf)", "Distance between samples.", pixels, "", "0.4"},
        {"unit", choice, "", "\"voxel\"", "voxel|world", "Unit of the step; voxel: the smallest spacing.", pixels, "",
         "\"world\""},
        {"jitter", number, "step", "0", "[0,1]", "Random part of the first step.", pixels, "", "0.5"},
        {"termination", number, "", "1e-4", "[0,1)", "A ray ends when its largest transmittance is at most this.",
         pixels, "", "0.5"},
        {"skipping", boolean, "", "true", "", "Empty space is skipped.", speed, "", "false"}}},
      {"sampling",
       "faces",
       "Segments from face to face of a mesh's cells, cut into equal parts where they are longer than a step.",
       {{"step", number, "see unit", "1", "(0,inf)", "The longest part.", pixels, faces_patch, "0.1"},
        {"unit", choice, "", "\"voxel\"", "voxel|world",
         "Unit of the step; voxel: the mean length of the mesh's edges.", pixels, faces_unit_patch, "\"world\""},
        {"termination", number, "", "1e-4", "[0,1)", "A ray ends when its largest transmittance is at most this.",
         pixels, faces_patch, "0.5"}}},
      {"sampling",
       "cells",
       "Segments on which the value is linear to a tolerance, cell by cell; for references (precision fp64).",
       {{"tolerance", number, "range of the data", "1e-6", "[1e-12,1]",
         "How far the value may be from linear on a segment, and the light factors (absolute) where it is shaded.",
         pixels, R"({"precision":"fp64"})", "0.05"},
        {"termination", number, "", "1e-4", "[0,1)", "A ray ends when its largest transmittance is at most this.",
         pixels, R"({"precision":"fp64"})", "0.5"}}},
      {"image",
       "",
       "The picture.",
       {{"size", json, "pixel", "[512,512]", "[width, height], whole numbers in [1,16384]", "Width and height.", pixels,
         "", "[20,24]", "",
         R"({"type":"array","minItems":2,"maxItems":2,"items":{"type":"integer","minimum":1,"maximum":16384}})"},
        {"supersampling", integer, "", "1", "[1,16]",
         "Rays per pixel along each side: a regular grid of n x n rays, whose mean is the pixel.", pixels, "", "2"},
        {"background", vector3, "", "[0,0,0]", "[0,inf)", "Radiance behind the data.", pixels, "", "[0.2,0.5,0.8]"},
        {"space", choice, "", "\"display\"", "display|linear",
         "Display: colours are composited as given; linear: sRGB colours are decoded before and encoded after.", pixels,
         "", "\"linear\""}},
       {{"size", image_size}}},
      {"limits",
       "",
       "What a case may use.",
       {{"memory", json, "byte", "null", "null (75 % of what is available) or a number of at least 1",
         "A case that needs more is refused.", nothing, "", "", "", R"({"type":["number","null"],"minimum":1})"},
        {"gpu_buffer", json, "byte", "null", "null (what the device offers) or a number of at least 1",
         "Largest storage buffer on a GPU; more is split into pages.", speed, R"({"backend":{"type":"vulkan"}})",
         "16384", "", R"({"type":["number","null"],"minimum":1})"}},
       {{"memory", null_or_bytes}, {"gpu_buffer", null_or_bytes}}},
      {"expect",
       "",
       "What an experiment's numbers must satisfy; one of at_least, at_most, between, order, affine.",
       {{"metric", text, "", nullptr, "",
         "A value of one of the metrics, e.g. psnr or psnr.r; of a case's own, e.g. light.min.", nothing},
        {"against", text, "", nullptr, "",
         "A reference's name; variant: the first variant case; itself: values without comparison, of the light volume "
         "and "
         "times.",
         nothing},
        {"over", choice, "", "\"cases\"", "cases|views",
         "Cases: every case that is meant; views: one value of all views (camera.view) that differ in nothing else.",
         nothing},
        {"take", choice, "", "\"worst\"", "worst|mean", "Which value of the views.", nothing, "", "", "over=views"},
        {"where", json, "", "{}", "a section of key path -> value", "The cases that are meant; empty: all.", nothing,
         "", "", "", R"({"type":"object"})"},
        {"at_least", json, "the metric's", "null", "null or a number", "Lower bound.", nothing, "", "", "",
         R"({"type":["number","null"]})"},
        {"at_most", json, "the metric's", "null", "null or a number", "Upper bound.", nothing, "", "", "",
         R"({"type":["number","null"]})"},
        {"between", json, "the metric's", "null", "null or [lo, hi]", "Both bounds.", nothing, "", "", "",
         R"({"type":["array","null"],"minItems":2,"maxItems":2,"items":{"type":"number"}})"},
        {"order", json, "", "null",
         "null or {\"by\": key path, \"is\": \"increasing\" or \"decreasing\", \"values\": the key's values in their "
         "order, where they are no numbers}",
         "How the metric follows an axis.", nothing, "", "", "",
         R"({"type":["object","null"],"properties":{"by":{"type":"string"},"is":{"enum":["increasing","decreasing"]},"values":{"type":"array","minItems":2}},"required":["by","is"],"additionalProperties":false})"},
        {"affine", json, "", "null",
         "null or {\"by\": key path, \"power\": p (1 unless given), \"within\": part of the metric's range}",
         "The metric is a + b key^p along an axis, up to that part of its range.", nothing, "", "", "",
         R"({"type":["object","null"],"properties":{"by":{"type":"string"},"power":{"type":"number"},"within":{"type":"number","minimum":0}},"required":["by","within"],"additionalProperties":false})"}},
       {{"where", section},
        {"at_least", null_or_number},
        {"at_most", null_or_number},
        {"between", null_or_range_or_equal},
        {"order", order},
        {"affine", affine}}},
  };
}

}  // namespace

const std::vector<SectionType>& section_types() {
  static const std::vector<SectionType> types = declare();
  return types;
}

const SectionType* find_section_type(const std::string& section, const std::string& type) {
  for (const SectionType& s : section_types()) {
    if (section == s.section && type == s.type) return &s;
  }
  return nullptr;
}

std::vector<std::string> types_of(const std::string& section) {
  std::vector<std::string> types;
  for (const SectionType& s : section_types()) {
    if (section == s.section) types.push_back(s.type);
  }
  return types;
}

const std::vector<std::string>& top_sections() {
  static const std::vector<std::string> names = {
      "include",  "data",  "sampler", "optical_model", "estimator", "lights",    "illumination", "camera", "clip",
      "sampling", "image", "limits",  "backend",       "axes",      "reference", "metrics",      "expect"};
  return names;
}

}  // namespace dvrlab

#include "tests/support/golden_case.h"

#include <cmath>
#include <stdexcept>

#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

json ray_through(const json& field, double length, int segments) {
  json data = {{"type", "procedural"}, {"evaluate", "formula"}, {"bounds", {{-8, -8, -8}, {8, 8, 8}}}};
  data.update(field);
  return {
      {"data", data},
      {"camera",
       {{"type", "ray"}, {"frame", "world"}, {"origin", {0, 0, 0}}, {"direction", {1, 0, 0}}, {"t", {0, length}}}},
      {"sampling",
       {{"type", "uniform"}, {"step", length / segments}, {"unit", "world"}, {"termination", 0}, {"skipping", false}}},
      {"image", {{"size", {1, 1}}}}};
}

json ramp(double v0, double v1, double length) {
  if (v0 == v1) return {{"field", "constant"}, {"value", v0}};
  return {{"field", "ramp"}, {"direction", {1, 0, 0}}, {"offset", v0}, {"scale", (v1 - v0) / length}};
}

json ray_config(const json& ray, int segments) {
  const std::string type = ray.at("type");
  if (type == "segment") {
    const double length = ray.at("dl");
    return ray_through(ramp(ray.at("v0"), ray.at("v1"), length), length, segments);
  }
  if (type == "radial")
    return ray_through({{"field", "radial"},
                        {"center", {ray.at("lc"), ray.at("p"), 0}},
                        {"scale", ray.value("scale", 1.0)},
                        {"offset", ray.value("offset", 0.0)}},
                       ray.at("D"), segments);
  if (type == "sin")
    return ray_through({{"field", "sinusoid"},
                        {"direction", {1, 0, 0}},
                        {"a", ray.at("a")},
                        {"b", ray.at("b")},
                        {"omega", ray.at("omega")},
                        {"phi", ray.at("phi")}},
                       ray.at("D"), segments);
  if (type == "polyline")
    return ray_through({{"field", "polyline"}, {"direction", {1, 0, 0}}, {"node", ray.at("points")}},
                       ray.at("points").back()[0], segments);
  throw std::logic_error("no config says a ray of type " + type);
}

json surface_of(const json& p) {
  json surface = json::object();
  if (p.contains("a_s")) surface["opacity"] = p["a_s"];
  if (p.contains("c_s")) surface["color"] = p["c_s"];
  for (const json& d : p.value("diracs", json::array()))
    surface["delta"].push_back({{"value", d["v"]}, {"opacity", d["alpha"]}, {"color", d["color"]}});
  return surface;
}

json model_of(const std::string& model, const json& p) {
  json m = {{"tf", "nodes"}};
  if (p.contains("dl_std")) m["dl_std"] = p["dl_std"];
  if (p.contains("dv_std")) m["dv_std"] = p["dv_std"];
  if (p.value("interp", std::string()) == "opacity") m["interpolation"] = "opacity";
  if (model == "absorption_emission") {
    m.update({{"type", "absorption_emission"}, {"extinction", p["tau"]}, {"color", p["color"]}});
  } else if (model == "williams_max") {
    m.update({{"type", "volume_density"},
              {"density", p["rho"]},
              {"chromaticity", p["kappa"]},
              {"form", p.value("normalized", false) ? "normalised" : "extinction"}});
  } else if (model == "levoy" || model == "hernell") {
    m.update({{"type", "absorption_emission"},
              {"shaded", model == "levoy"},
              {"opacity", p["alpha"]},
              {"color", p["color"]}});
  } else if (model == "kraus") {
    m.update({{"type", "data_space"}, {"surface", surface_of(p)}});
  } else if (model == "hybrid") {
    m.update({{"type", "hybrid"}, {"surface", surface_of(p)}});
    const auto pair = [&](const char* key, const char* first, const char* a, const char* second, const char* b) {
      if (p.contains(a)) m[key] = {{first, p[a]}, {second, p[b]}};
    };
    pair("scattering", "opacity", "a_ps", "color", "c_ps");
    pair("absorption", "density", "a_pa", "transmission_color", "c_pa");
    pair("emission", "intensity", "e_p", "color", "c_pe");
  } else {
    throw std::logic_error("no optical model " + model);
  }
  return m;
}

void add_light(const json& shade, bool to_particles, json& config) {
  if (shade.is_null()) return;
  if (shade.at("type") == "linear") {
    json pass = {{"type", "prescribed"}};
    if (to_particles) pass.update({{"m0", shade["k0"]}, {"m1", shade["k1"]}});
    pass.update({{"k0", shade["k0"]}, {"k1", shade["k1"]}, {"b0", shade["b0"]}, {"b1", shade["b1"]}});
    config["illumination"] = json::array({pass});
    return;
  }
  config["lights"] = json::array({{{"type", "head"}}});
  config["illumination"] = json::array({{{"type", "blinn_phong"},
                                         {"ambient", shade.at("ka")},
                                         {"diffuse", shade.at("kd")},
                                         {"specular", shade.at("ks")},
                                         {"shininess", shade.at("n")}}});
}

}  // namespace

json golden_case(const std::string& id) {
  if (golden().is_null()) return nullptr;
  for (const json& c : golden().at("cases"))
    if (c.at("id") == id) return c;
  throw std::logic_error("no golden case " + id);
}

json golden_config(const json& g, int segments) {
  json config = ray_config(g.at("ray"), segments);
  config["optical_model"] = model_of(g.at("model"), g.at("params"));
  if (g.contains("shade")) add_light(g["shade"], g["model"] == "hernell", config);
  if (g.contains("background")) config["image"]["background"] = g["background"];
  return config;
}

std::vector<std::string> golden_rays() {
  std::vector<std::string> ids;
  if (golden().is_null()) return ids;
  for (const json& c : golden().at("cases"))
    if (c.at("kind") == "ray" && c.at("ray").at("type") != "element") ids.push_back(c.at("id"));
  return ids;
}

RayIntegral golden_integral(const json& g) {
  RayIntegral r;
  for (std::size_t c = 0; c < 3; ++c) {
    r.I[c] = std::stod(g.at("expect").at("I")[c].get<std::string>());
    r.T[c] = std::stod(g.at("expect").at("T")[c].get<std::string>());
  }
  return r;
}

json golden_medium_config(const std::string& name, int segments, bool backwards) {
  const json& m = golden().at("media").at(name);
  const double a = 0.0037, b = 0.9963;
  json config = ray_through(backwards ? ramp(b, a, 1) : ramp(a, b, 1), 1, segments);
  config["optical_model"] = model_of(m.at("model"), m.at("params"));
  return config;
}

}  // namespace dvrlab::test

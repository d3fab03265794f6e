// What `dvrlab doctor` prints.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "framework/app/doctor.h"

namespace dvrlab {

std::string doctor_text(const Doctor& doctor);
nlohmann::ordered_json doctor_json(const Doctor& doctor);

}  // namespace dvrlab

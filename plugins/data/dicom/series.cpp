#include "plugins/data/dicom/series.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>

#include "framework/interfaces/error.h"
#include "plugins/data/dicom/element_lengths.h"
#include "plugins/data/dicom/image_header.h"

namespace dvrlab::dicom {
namespace {

namespace fs = std::filesystem;

bool begins_like_dicom(const fs::path& file) {
  std::array<char, 132> start{};
  std::ifstream in(file, std::ios::binary);
  return in.read(start.data(), start.size()) && has_magic(std::as_bytes(std::span(start)));
}

std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, fs::directory_options::skip_permission_denied))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

struct Found {
  SeriesKey key;
  std::vector<std::string> file;
  int slices = 0;
};

std::string text_of(const Found& f) {
  return f.key.uid + " (" + std::to_string(f.slices) + (f.slices == 1 ? " slice, " : " slices, ") + f.key.modality +
         " \"" + f.key.description + "\")";
}

std::string list_of(const std::map<std::string, Found>& all) {
  std::string list;
  for (const auto& [uid, found] : all) list += (list.empty() ? "" : "; ") + text_of(found);
  return list;
}

// The UIDs that are `wanted` or begin with it; the whole UID wins over longer ones.
std::vector<std::string> fitting(const std::map<std::string, Found>& all, const std::string& wanted) {
  if (all.contains(wanted)) return {wanted};
  std::vector<std::string> uids;
  for (const auto& [uid, found] : all)
    if (uid.starts_with(wanted)) uids.push_back(uid);
  return uids;
}

// The series of one file decides, unless the config asks for another one.
std::string uid_of_file(const std::string& path, const std::string& wanted, const std::string& series_key) {
  const auto own = read_series(path);
  if (!own) throw InputError(path + ": is a DICOM file without an image (a report or a directory)");
  if (!own->uid.starts_with(wanted))
    throw InputError(series_key + ": " + path + " belongs to the series " + own->uid + ", not to \"" + wanted +
                     "\"; name the folder, or a file of that series");
  return own->uid;
}

}  // namespace

SeriesFiles find_series(const std::string& path, const std::string& wanted, const std::string& series_key) {
  const bool one_file = !fs::is_directory(path);
  const std::string chosen = one_file ? uid_of_file(path, wanted, series_key) : wanted;
  const fs::path folder = one_file ? fs::path(path).parent_path() : fs::path(path);
  SeriesFiles result;
  std::map<std::string, Found> all;
  std::size_t others = 0, without_image = 0;
  for (const fs::path& file : files_of(folder)) {
    if (!begins_like_dicom(file)) {
      ++others;
      continue;
    }
    const auto key = read_series(file.string());
    if (!key) {
      ++without_image;
      continue;
    }
    Found& found = all.try_emplace(key->uid, Found{*key, {}, 0}).first->second;
    found.file.push_back(file.string());
    found.slices += key->frames;
  }
  if (all.empty())
    throw InputError(folder.string() + ": holds no DICOM image (a file with \"DICM\" at byte 128); " +
                     std::to_string(others + without_image) + " other files, subfolders are not searched");
  const auto uids = one_file ? std::vector{chosen} : fitting(all, chosen);
  if (uids.empty())
    throw InputError(series_key + ": no series of " + folder.string() + " begins with \"" + chosen + "\"; it holds " +
                     list_of(all));
  if (uids.size() > 1)
    throw InputError(series_key + ": " + folder.string() + " holds several series" +
                     (chosen.empty() ? "" : " that begin with \"" + chosen + "\"") + "; choose one (--set " +
                     series_key + "=UID): " + list_of(all));
  result.file = all.at(uids[0]).file;
  result.notes.push_back("series " + text_of(all.at(uids[0])));
  if (all.size() > 1)
    result.notes.push_back(std::to_string(all.size() - 1) + " other series of the folder are not read");
  if (others + without_image > 0)
    result.notes.push_back(std::to_string(others + without_image) + " files of the folder are no DICOM images");
  return result;
}

bool holds_dicom(const std::string& folder) noexcept {
  try {
    const auto files = files_of(folder);
    return std::any_of(files.begin(), files.end(), begins_like_dicom);
  } catch (...) {
    return false;
  }
}

}  // namespace dvrlab::dicom

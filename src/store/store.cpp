// SPDX-License-Identifier: BSD-3-Clause
#include "store/store.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "store/files.h"
#include "store/sha256.h"

namespace tonetool::store {

namespace {

namespace fs = std::filesystem;

constexpr size_t kHashDigits = 12; ///< in the name of an image

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() &&
           text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string last_part(const std::string& name) {
    return name.substr(name.rfind('/') + 1);
}

// Else a name could lead out of the store, or be none that it lists.
void check_name(const std::string& name) {
    for (size_t begin = 0; begin <= name.size();) {
        const size_t end = std::min(name.find('/', begin), name.size());
        if (end == begin || name[begin] == '.')
            throw std::runtime_error("\"" + name + "\" is no name of a case");
        begin = end + 1;
    }
}

void check_key(const std::string& key) {
    const bool plain = std::all_of(key.begin(), key.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-';
    });
    if (!plain)
        throw std::runtime_error("the key \"" + key +
                                 "\" has other signs than letters, digits, - and _");
}

// What the names of a case's images begin with; the extension is the file's.
std::string image_stem(const std::string& name, const std::string& key, const std::string& sha256) {
    return last_part(name) + (key.empty() ? "" : "@" + key) + "." + sha256.substr(0, kHashDigits);
}

std::string image_name(const Approval& approval) {
    return image_stem(approval.name, approval.key, approval.sha256) +
           fs::path(approval.file).extension().string();
}

// "long.3fa2b1c4d5e6.exr": what an approval writes.
bool is_image_name(const std::string& file) {
    const std::string stem = fs::path(file).stem().string();
    const size_t dot = stem.rfind('.');
    return dot != std::string::npos && dot > 0 && stem.size() - dot - 1 == kHashDigits &&
           stem.find_first_not_of("0123456789abcdef", dot + 1) == std::string::npos;
}

// The oid of git-lfs's pointer; empty where the file is none.
std::string pointed_at(const std::string& file) {
    constexpr size_t most = 1024; // of the specification
    std::error_code why;
    if (fs::file_size(file, why) >= most || why)
        return "";
    const std::string text = read_file(file), oid = "\noid sha256:";
    const size_t at = text.find(oid);
    const bool pointer = text.compare(0, 43, "version https://git-lfs.github.com/spec/v1\n") == 0 &&
                         at != std::string::npos;
    return pointer ? text.substr(at + oid.size(), 64) : "";
}

// Visits the files of a folder and those below, without what begins with a dot.
template <class Visit>
void each_file(const std::string& folder, const std::string& below, const Visit& visit) {
    std::set<std::string> folders;
    if (!fs::is_directory(folder + "/" + below))
        return;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder + "/" + below)) {
        const std::string name = entry.path().filename().string();
        if (name.front() == '.')
            continue;
        if (entry.is_directory())
            folders.insert(below + name + "/");
        else
            visit(below + name);
    }
    for (const std::string& one : folders)
        each_file(folder, one, visit);
}

std::string name_of_record(const std::string& file) {
    return file.substr(0, file.size() - std::string(kRecordEnding).size());
}

} // namespace

std::string Store::record_file(const std::string& name) const {
    return m_folder + "/" + name + kRecordEnding;
}

std::vector<std::string> Store::names() const {
    std::set<std::string> names;
    each_file(m_folder, "", [&](const std::string& file) {
        if (ends_with(file, kRecordEnding))
            names.insert(name_of_record(file));
    });
    return {names.begin(), names.end()};
}

std::vector<std::string> Store::names_without_record() const {
    std::set<std::string> known, images, found;
    each_file(m_folder, "", [&](const std::string& file) {
        if (ends_with(file, kRecordEnding))
            known.insert(name_of_record(file));
        else if (is_image_name(last_part(file)))
            images.insert(fs::path(file).replace_extension().replace_extension().string());
    });
    for (std::string name : images) {
        if (known.count(name) > 0)
            continue;
        const size_t at = name.rfind('@'); // a key, unless the name has that sign itself
        if (at != std::string::npos && name.find('/', at) == std::string::npos)
            name.resize(at);
        if (known.count(name) == 0)
            found.insert(name);
    }
    return {found.begin(), found.end()};
}

std::optional<ApprovedRecord> Store::find(const std::string& name) const {
    const std::string file = record_file(name);
    std::error_code none;
    if (!fs::exists(file, none))
        return std::nullopt;
    try {
        ApprovedRecord record = record_from(read_file(file));
        for (const ApprovedImage& image : record.images) {
            const std::string start = image_stem(name, image.key, image.sha256);
            if (image.file.compare(0, start.size(), start) != 0)
                throw std::runtime_error("names \"" + image.file +
                                         "\", which is of another case, key or hash");
        }
        return record;
    } catch (const std::runtime_error& problem) {
        throw std::runtime_error("\"" + file + "\" " + problem.what());
    }
}

std::vector<ApprovedImage> Store::accepted(const std::string& name, const std::string& key) const {
    const auto record = find(name);
    std::vector<ApprovedImage> found;
    for (const std::string& wanted : {key, std::string()}) {
        for (const ApprovedImage& image : record ? record->images : std::vector<ApprovedImage>())
            if (image.key == wanted)
                found.push_back(image);
        if (!found.empty())
            break;
    }
    return found;
}

std::string Store::file(const std::string& name, const ApprovedImage& image) const {
    return m_folder + "/" + name.substr(0, name.rfind('/') + 1) + image.file;
}

Found Store::look(const std::string& name, const ApprovedImage& image) const {
    const std::string place = file(name, image);
    std::error_code none;
    if (!fs::exists(place, none))
        return Found::Gone;
    if (sha256_of_file(place) == image.sha256)
        return Found::Approved;
    return pointed_at(place) == image.sha256 ? Found::NotFetched : Found::Other;
}

std::string Store::problem(const std::string& name, const ApprovedImage& image) const {
    const std::string place = "\"" + file(name, image) + "\"";
    switch (look(name, image)) {
    case Found::Gone:
        return place + " is approved and not there";
    case Found::NotFetched:
        return place + " is not fetched: git lfs pull";
    case Found::Other:
        return place + " is not what was approved";
    case Found::Approved:
        break;
    }
    return "";
}

std::vector<std::string> Store::problems() const {
    std::vector<std::string> problems;
    std::set<std::string> named;
    for (const std::string& name : names()) {
        const auto record = find(name);
        for (const ApprovedImage& image : record ? record->images : std::vector<ApprovedImage>()) {
            named.insert(file(name, image));
            if (const std::string why = problem(name, image); !why.empty())
                problems.push_back(why);
        }
    }
    each_file(m_folder, "", [&](const std::string& file) {
        if (!ends_with(file, kRecordEnding) && named.count(m_folder + "/" + file) == 0)
            problems.push_back("\"" + m_folder + "/" + file + "\" has no record");
    });
    return problems;
}

namespace {

// What killed runs have left in the folder, and images that no record names any more.
void clear_folder(const Store& store, const std::string& root, const std::string& below) {
    std::set<std::string> named, files;
    const std::string folder = root + "/" + below;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (!entry.is_directory())
            files.insert(entry.path().filename().string());
    for (const std::string& file : files) {
        if (!ends_with(file, kRecordEnding) || file.front() == '.')
            continue;
        const auto record =
            store.find(below + file.substr(0, file.size() - std::string(kRecordEnding).size()));
        for (const ApprovedImage& image : record ? record->images : std::vector<ApprovedImage>())
            named.insert(image.file);
    }
    for (const std::string& file : files) {
        const bool temporary = file.compare(0, std::string(kTemporary).size(), kTemporary) == 0;
        if (temporary || (is_image_name(file) && named.count(file) == 0))
            remove_file(folder + file);
    }
}

// What was approved holds already. Of a folder with a record that cannot be read nobody knows which
// images are named: it stays as it is, and problems() tells of it.
void clear_folders(const Store& store, const std::string& root,
                   const std::set<std::string>& folders) {
    for (const std::string& below : folders) {
        try {
            clear_folder(store, root, below);
        } catch (const std::runtime_error&) {
            continue;
        }
    }
}

void take(ApprovedRecord& record, const Approval& approval) {
    ApprovedImage image{
        approval.key, image_name(approval), approval.sha256, fs::file_size(approval.file),
        approval.by,  approval.at,          approval.reason, {}};
    std::vector<ApprovedImage> rest;
    for (const ApprovedImage& other : record.images) {
        const bool same = other.key == image.key && other.sha256 == image.sha256;
        if (other.key != approval.key || (approval.add && !same))
            rest.push_back(other);
        else if (!same)
            image.replaces.push_back(other.sha256);
    }
    rest.push_back(image);
    record.images = rest;
}

} // namespace

void Store::approve(const std::vector<Approval>& approvals) {
    for (const Approval& approval : approvals) {
        check_name(approval.name);
        check_key(approval.key);
        if (sha256_of_file(approval.file) != approval.sha256)
            throw std::runtime_error("\"" + approval.file +
                                     "\" has changed since the run that was looked at");
    }
    const StoreLock lock(m_folder);
    std::set<std::string> folders;
    for (const Approval& approval : approvals) {
        ApprovedRecord record = find(approval.name).value_or(ApprovedRecord{});
        const std::string below = approval.name.substr(0, approval.name.rfind('/') + 1);
        copy_whole(approval.file, m_folder + "/" + below + image_name(approval), approval.sha256);
        take(record, approval);
        write_whole(record_file(approval.name), record_text(record)); // from here on it holds
        folders.insert(below);
    }
    clear_folders(*this, m_folder, folders);
}

void Store::retire(const std::vector<std::string>& names) {
    const StoreLock lock(m_folder);
    for (const std::string& name : names) {
        check_name(name);
        if (!find(name))
            throw std::runtime_error("nothing is approved for \"" + name + "\"");
    }
    std::set<std::string> folders;
    for (const std::string& name : names) {
        remove_file(record_file(name));
        folders.insert(name.substr(0, name.rfind('/') + 1));
    }
    clear_folders(*this, m_folder, folders);
}

} // namespace tonetool::store

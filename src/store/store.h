// SPDX-License-Identifier: BSD-3-Clause
// Approved images: a folder with one record for each case and the images beside it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "store/record.h"

namespace tonetool::store {

/// What there is in place of an approved image.
enum class Found {
    Approved,   ///< the bytes that were approved
    NotFetched, ///< git-lfs's pointer to them
    Other,      ///< other bytes
    Gone
};

/// An image that is to be approved.
struct Approval {
    std::string name;   ///< of the case: "hair/long"
    std::string file;   ///< the image
    std::string sha256; ///< that it had when it was seen
    std::string key{};
    std::string by, at, reason;
    bool add = false; ///< beside the key's images, not in place of them
};

/// Reading takes no lock: a record is replaced whole, and its images are there before it is.
class Store {
public:
    explicit Store(std::string folder) : m_folder(std::move(folder)) {}

    const std::string& folder() const { return m_folder; }
    /// The names of all cases, by bytes. Names with a part that begins with a dot are none.
    std::vector<std::string> names() const;
    /// nullopt where nothing is approved; a runtime_error where the record cannot be read.
    std::optional<ApprovedRecord> find(const std::string& name) const;
    /// The images with that key; where there is none, those without a key.
    std::vector<ApprovedImage> accepted(const std::string& name, const std::string& key) const;
    std::string file(const std::string& name, const ApprovedImage& image) const;
    Found look(const std::string& name, const ApprovedImage& image) const;
    /// What is wrong with the image; empty where it is what was approved.
    std::string problem(const std::string& name, const ApprovedImage& image) const;
    /// Cases whose images are there and whose record is not: removed by hand, or an approval that
    /// was ended.
    std::vector<std::string> names_without_record() const;
    /// What is wrong with the store, a sentence each: images that are not what was approved, and
    /// those without a record.
    std::vector<std::string> problems() const;

    /// Copies the images and writes the records, one case after the other: killed at any moment, or
    /// with others at the same time, each record is whole and its images are there. A runtime_error
    /// where a file is not what was seen any more, before anything is written.
    void approve(const std::vector<Approval>& approvals);
    /// Removes the records and images of these cases.
    void retire(const std::vector<std::string>& names);

private:
    std::string record_file(const std::string& name) const;

    std::string m_folder;
};

} // namespace tonetool::store

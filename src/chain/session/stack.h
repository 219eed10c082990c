// SPDX-License-Identifier: BSD-3-Clause
// What the commands of a line work on: images, their labels, variables.
#pragma once

#include <ctime>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "chain/images/output.h"

namespace tonetool::chain {

/// `taken`: commands have popped images before.
inline std::string too_few_images(size_t needed, size_t there, bool taken) {
    return "needs " + std::to_string(needed) + " image(s), the stack has " + std::to_string(there) +
           (taken ? "; commands before it took theirs (--dup keeps one, --against and --qc leave "
                    "all)"
                  : "");
}

struct Stack {
    std::vector<ImagePtr> images; ///< the top is the last
    std::map<std::string, ImagePtr> labels;
    OIIO::ParamValueList variables; ///< of --set and --for
    std::string waiting;            ///< the operator that waits for images; empty if none does

    // Of the images that were read.
    ReadTypes types;
    std::optional<OIIO::ImageSpec> first_header;
    std::time_t newest_input = 0;
    std::vector<std::string> files_read;
    bool taken = false; ///< images have been popped

    const ImagePtr& top() const { return images.back(); }
    /// The images on top, the deepest first.
    std::vector<ImagePtr> top(size_t count) const {
        return {images.end() - std::ptrdiff_t(count), images.end()};
    }
    void push(ImagePtr image) { images.push_back(std::move(image)); }
    std::vector<ImagePtr> pop(size_t count) {
        std::vector<ImagePtr> popped = top(count);
        taken |= count > 0;
        images.resize(images.size() - count);
        return popped;
    }

    /// The complaint that there are not so many images.
    std::string lacks(int count) const {
        return too_few_images(size_t(count), images.size(), taken);
    }

    /// Reads what images and labels still have to read from a file about to be replaced.
    void keep_pixels_of(const std::string& filename) const;
};

} // namespace tonetool::chain

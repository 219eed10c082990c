// SPDX-License-Identifier: BSD-3-Clause
// Pictures that were made lately, for all threads.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "recipe/picture.h"

namespace tonetool::recipe {

class Shelf {
public:
    /// As many bytes and pictures are kept; the picture used last is kept in any case.
    static constexpr size_t most_bytes = size_t(256) << 20, most_pictures = 64;

    struct Entry;

    /// The place of a picture, held so that it is made once by one thread.
    class Place {
    public:
        /// Waits for who makes the picture, or else goes on without it.
        Place(const std::string& key, bool waits);

        /// The picture that was made, if it still is what its inputs make.
        PicturePtr picture() const;
        void keep(const PicturePtr& picture);

    private:
        std::string m_key;
        std::shared_ptr<Entry> m_entry;
        std::unique_lock<std::mutex> m_lock;
    };
};

} // namespace tonetool::recipe

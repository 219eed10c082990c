// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/shelf.h"

#include <algorithm>
#include <list>

namespace tonetool::recipe {

struct Shelf::Entry {
    std::string key;
    std::mutex making; ///< held while the picture is made or looked at
    PicturePtr picture;
    size_t bytes = 0; ///< of the picture; under the lock of all entries
};

namespace {

struct Entries {
    std::mutex lock;
    std::list<std::shared_ptr<Shelf::Entry>> list; ///< the one used last comes first
};

// Never destroyed: threads may still read when the process ends.
Entries& entries() {
    static Entries& all = *new Entries;
    return all;
}

// Who holds an entry that is thrown away here keeps it for himself.
void throw_away_old(Entries& all) {
    size_t bytes = 0, count = 0;
    for (auto entry = all.list.begin(); entry != all.list.end();) {
        bytes += (*entry)->bytes;
        const bool fits = bytes <= Shelf::most_bytes && ++count <= Shelf::most_pictures;
        const bool used = entry->use_count() > 1;
        entry =
            fits || used || entry == all.list.begin() ? std::next(entry) : all.list.erase(entry);
    }
}

std::shared_ptr<Shelf::Entry> entry_of(const std::string& key) {
    Entries& all = entries();
    const std::lock_guard<std::mutex> hold(all.lock);
    auto found = std::find_if(all.list.begin(), all.list.end(),
                              [&](const auto& entry) { return entry->key == key; });
    if (found != all.list.end()) {
        all.list.splice(all.list.begin(), all.list, found);
    } else {
        all.list.push_front(std::make_shared<Shelf::Entry>());
        all.list.front()->key = key;
        throw_away_old(all);
    }
    return all.list.front();
}

} // namespace

Shelf::Place::Place(const std::string& key, bool waits)
    : m_key(key),
      m_entry(entry_of(key)),
      m_lock(m_entry->making, std::defer_lock) {
    if (waits)
        m_lock.lock();
    else
        (void)m_lock.try_lock();
}

PicturePtr Shelf::Place::picture() const {
    const bool known = m_lock.owns_lock() && m_entry->picture;
    return known && sequence::is_current(m_entry->picture->inputs) ? m_entry->picture : nullptr;
}

void Shelf::Place::keep(const PicturePtr& picture) {
    if (!m_lock.owns_lock())
        return;
    m_entry->picture = picture;
    Entries& all = entries();
    const std::lock_guard<std::mutex> hold(all.lock);
    m_entry->bytes = picture->bytes;
    throw_away_old(all);
}

} // namespace tonetool::recipe

// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/named_files.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "sequence/frames/folder_walk.h"
#include "sequence/frames/renamed.h"

namespace tonetool::sequence {

namespace {

constexpr size_t kAnyDepth = std::numeric_limits<size_t>::max();

// The folder that all files of the pattern are below, "" or with a / at its end.
std::string fixed_folder(const NamePattern& pattern) {
    const std::string text = pattern.fixed_part();
    return text.substr(0, text.rfind('/') + 1);
}

// A word that begins with a dash is a command.
std::string as_word(const std::string& file) {
    return (file.compare(0, 1, "-") == 0 ? "./" : "") + file;
}

// ---- which wildcards a side has

struct NamedSide {
    const Side& side;
    NamePattern pattern;

    NamedSide(const Side& from, const PatternOptions& options)
        : side(from),
          pattern(printf_style(from.pattern, options.padding), options.names) {}

    /// What the side can tell of an item.
    Item seen(const Item& item) const {
        return {pattern.has_number() ? item.frame : 0, pattern.has_view() ? item.view : "",
                pattern.has_name() ? item.name : "", pattern.has_method() ? item.method : ""};
    }
};

class NamedUnion {
public:
    NamedUnion(const std::vector<Side>& sides, const PatternOptions& options) : m_options(options) {
        for (const Side& side : sides) {
            m_sides.emplace_back(side, options);
            const NamePattern& pattern = m_sides.back().pattern;
            m_name |= pattern.has_name();
            m_method |= pattern.has_method();
            m_number |= pattern.has_number();
            m_view |= pattern.has_view();
        }
    }

    Pairing pairing() {
        take_whole_sides();
        for (const NamedSide& side : m_sides)
            add_unseen(side);
        if (m_method)
            complete_methods();
        complete_frames();
        if (m_keys.empty())
            throw std::runtime_error(nothing_text());
        Pairing pairs;
        pairs.items = {m_keys.begin(), m_keys.end()};
        pairs.absent.resize(pairs.items.size());
        for (const NamedSide& side : m_sides)
            pairs.names.push_back(names_of_side(side, pairs.items));
        pairs.own.resize(m_sides.size());
        tell_absent(pairs);
        return pairs;
    }

private:
    bool is_whole(const NamedSide& side) const {
        const NamePattern& pattern = side.pattern;
        return pattern.has_name() == m_name && pattern.has_method() == m_method &&
               pattern.has_number() == m_number && pattern.has_view() == m_view;
    }

    void take_whole_sides() {
        bool any = false;
        for (const NamedSide& side : m_sides) {
            if (!is_whole(side))
                continue;
            any = true;
            m_keys.insert(side.side.files.items.begin(), side.side.files.items.end());
            m_keys.insert(side.side.files.lost.begin(), side.side.files.lost.end());
        }
        if (!any) {
            throw std::runtime_error("no name has all the wildcards of the others (valid: one with "
                                     "each of them, as out/%M/%N.exr beside refs/%N.exr)");
        }
        if (m_keys.empty() && m_method)
            throw std::runtime_error(nothing_text());
        for (size_t s = m_sides.size(); s-- > 0 && m_methods.empty();) // those of the tests
            if (m_sides[s].pattern.has_method())
                for (const Item& item : m_sides[s].side.files.items)
                    m_methods.insert(item.method);
        for (const NamedSide& side : m_sides)
            m_methods.insert(side.side.files.empty_methods.begin(),
                             side.side.files.empty_methods.end());
        if (m_methods.empty())
            m_methods.insert("");
    }

    // What no other side has a file for.
    void add_unseen(const NamedSide& side) {
        if (is_whole(side))
            return;
        std::set<Item> seen;
        for (const Item& item : m_keys)
            seen.insert(side.seen(item));
        std::vector<Item> known = side.side.files.items;
        known.insert(known.end(), side.side.files.lost.begin(), side.side.files.lost.end());
        for (const Item& item : known) {
            if (seen.count(item) > 0)
                continue;
            for (const std::string& method : m_methods) {
                Item key = item;
                key.method = method;
                key.view = m_view && item.view.empty() ? m_options.views.front() : item.view;
                m_keys.insert(key);
            }
        }
    }

    // A method must have each name, in the frames and views that the others have of it.
    void complete_methods() {
        std::map<std::string, std::set<std::pair<int, std::string>>> of_name;
        std::set<std::pair<std::string, std::string>> there;
        for (const Item& item : m_keys) {
            of_name[item.name].emplace(item.frame, item.view);
            there.emplace(item.name, item.method);
        }
        for (const auto& [name, frames] : of_name)
            for (const std::string& method : m_methods)
                if (there.count({name, method}) == 0)
                    for (const auto& [frame, view] : frames)
                        m_keys.insert({frame, view, name, method});
    }

    // Of each name and method: those of a range, else the numbers in between, and all views.
    void complete_frames() {
        if (!m_number && !m_view)
            return;
        std::map<std::pair<std::string, std::string>, std::set<Item>> series;
        for (const Item& item : m_keys)
            series[{item.name, item.method}].insert(item);
        const std::string range = range_of_all();
        m_keys.clear();
        for (auto& [of, items] : series) {
            if (m_number && !range.empty()) {
                items.clear();
                for (const int frame : parse_frames(range, false))
                    items.insert(
                        {frame, m_view ? m_options.views.front() : "", of.first, of.second});
            }
            const std::set<Item> numbers = items;
            for (const std::string& view : m_view ? m_options.views : std::vector<std::string>{})
                for (Item item : numbers) {
                    item.view = view;
                    items.insert(item);
                }
            if (m_number && range.empty())
                fill_holes(items);
            m_keys.insert(items.begin(), items.end());
        }
    }

    std::string range_of_all() const {
        std::string range = m_options.frames;
        for (const NamedSide& side : m_sides) {
            const std::string own = own_range(side.side.pattern);
            if (own.empty() || own == range)
                continue;
            if (!range.empty()) {
                throw std::runtime_error("\"" + side.side.pattern + "\" has the frames " + own +
                                         ", others have " + range +
                                         " (valid with %N: one range for all)");
            }
            range = own;
        }
        return range;
    }

    std::vector<std::string> names_of_side(const NamedSide& side,
                                           const std::vector<Item>& items) const {
        std::map<Item, std::string> known;
        for (size_t i = 0; i < side.side.files.items.size(); ++i)
            known.emplace(side.side.files.items[i], side.side.files.names[i]);
        std::vector<std::string> names;
        for (const Item& item : items) {
            const auto found = known.find(side.seen(item));
            names.push_back(found == known.end() ? as_word(side.pattern.filled(item))
                                                 : as_word(found->second));
        }
        return names;
    }

    void tell_absent(Pairing& pairs) const {
        std::vector<std::vector<bool>> lacks;
        for (const NamedSide& side : m_sides) {
            const std::set<Item> there(side.side.files.items.begin(), side.side.files.items.end());
            std::vector<bool>& lacking = lacks.emplace_back();
            for (const Item& item : pairs.items)
                lacking.push_back(there.count(side.seen(item)) == 0);
        }
        const std::vector<std::string> hints = lacks.size() > 1
                                                   ? renamed_hints(pairs, lacks[0], lacks[1])
                                                   : std::vector<std::string>(pairs.items.size());
        size_t looked = 0;
        constexpr size_t most = 64; // folders are read for a hint
        for (size_t s = lacks.size(); s-- > 0;)
            for (size_t i = 0; i < pairs.items.size(); ++i)
                if (lacks[s][i]) {
                    const bool reference = s == 0 && lacks.size() > 1;
                    const std::string& said = m_sides[s].side.lacks;
                    pairs.absent[i] =
                        (!said.empty() ? said
                                       : (reference ? "no reference \"" : "no test \"") +
                                             pairs.names[s][i] + "\"") +
                        (hints[i].empty() && said.empty() && ++looked <= most
                             ? sibling_of(pairs.names[s][i])
                             : hints[i]);
                }
    }

    // Of a file that is not there: one of its folder whose name differs by its ending or by
    // capitals.
    std::string sibling_of(const std::string& file) const {
        namespace fs = std::filesystem;
        const fs::path path(file);
        const auto bare = [](const fs::path& name) {
            return OIIO::Strutil::lower(name.stem().string());
        };
        std::error_code problem;
        fs::directory_iterator entry(path.has_parent_path() ? path.parent_path() : ".", problem);
        std::string found;
        for (const fs::directory_iterator end; !problem && entry != end; entry.increment(problem)) {
            const fs::path name = entry->path().filename();
            if (bare(name) == bare(path.filename()) && (found.empty() || name.string() < found))
                found = name.string();
        }
        return found.empty() ? "" : ", though \"" + found + "\" is there";
    }

    // "refs/%N.exr matches no file; refs/ has 12 files, all .png"
    std::string nothing_text() const {
        const NamedSide* named = &m_sides.front();
        for (const NamedSide& side : m_sides)
            if (is_whole(side) && side.side.files.items.empty())
                named = is_whole(*named) && named->side.files.items.empty() ? named : &side;
        const std::string folder = fixed_folder(named->pattern);
        const std::string start = named->side.pattern + " matches no file; ";
        std::error_code none;
        if (!folder.empty() && !std::filesystem::is_directory(folder, none))
            return start + "there is no folder \"" + folder + "\"";
        std::map<std::string, size_t> kinds;
        const auto files = files_below(folder, kAnyDepth, named->side.pattern);
        for (const std::string& file : files)
            ++kinds[std::filesystem::path(file).extension().string()];
        const auto most =
            std::max_element(kinds.begin(), kinds.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; });
        std::string text = start + (folder.empty() ? "./" : folder) + " has " +
                           std::to_string(files.size()) + (files.size() == 1 ? " file" : " files");
        if (most != kinds.end() && !most->first.empty())
            text += (most->second == files.size() ? ", all " : ", most of them ") + most->first;
        return text;
    }

    const PatternOptions& m_options;
    std::vector<NamedSide> m_sides;
    bool m_name = false, m_method = false, m_number = false, m_view = false;
    std::set<Item> m_keys;
    std::set<std::string> m_methods;
};

// Nothing in it but folders of which that holds, too.
bool holds_no_file(const std::filesystem::path& folder) {
    std::error_code problem;
    std::filesystem::recursive_directory_iterator entry(folder, problem);
    for (const std::filesystem::recursive_directory_iterator end; !problem && entry != end;
         entry.increment(problem))
        if (entry->is_symlink(problem) || !entry->is_directory(problem))
            return false;
    return !problem;
}

// Of "out/%M/...", what has made its folder and no file in it: all of it is missing. A link, which
// may be to the folder of another method, is none.
std::vector<std::string> empty_methods_in(const std::string& folder) {
    std::vector<std::string> empty;
    std::error_code problem;
    std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, problem);
    for (const std::filesystem::directory_iterator end; !problem && entry != end;
         entry.increment(problem)) {
        const std::string name = entry->path().filename().string();
        if (name.front() != '.' && !entry->is_symlink(problem) && entry->is_directory(problem) &&
            holds_no_file(entry->path()))
            empty.push_back(name);
    }
    return empty;
}

} // namespace

Files list_named(const std::string& pattern, const PatternOptions& options) {
    const std::string text = printf_style(pattern, options.padding);
    const NamePattern named(text, options.names);
    const std::string folder = fixed_folder(named);
    const auto below = text.begin() + std::ptrdiff_t(folder.size());
    const size_t depth = named.has_name() ? kAnyDepth : size_t(std::count(below, text.end(), '/'));
    Files listing;
    listing.from_disk = true;
    listing.own_range = has_range(pattern);
    std::vector<std::pair<Item, std::string>> found;
    if (named.has_method() && text.compare(folder.size(), 3, "%M/") == 0)
        listing.empty_methods = empty_methods_in(folder);
    for (const std::string& path : files_below(folder, depth, pattern)) {
        const std::string file = folder + path;
        for (const std::string& view :
             named.has_view() ? options.views : std::vector<std::string>{""}) {
            const auto match = named.match(file, view);
            if (!match)
                continue;
            if (!match->number.of_width) {
                listing.narrow.push_back(file);
                continue;
            }
            if (match->number.beyond)
                listing.beyond.push_back(file);
            found.emplace_back(Item{match->number.value, view, match->name, match->method}, file);
        }
    }
    std::sort(found.begin(), found.end());
    for (auto& [item, file] : found) {
        listing.items.push_back(item);
        listing.names.push_back(file);
    }
    return listing;
}

Pairing pair_named(const std::vector<Side>& sides, const PatternOptions& options) {
    return NamedUnion(sides, options).pairing();
}

} // namespace tonetool::sequence

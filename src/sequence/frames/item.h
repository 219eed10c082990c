// SPDX-License-Identifier: BSD-3-Clause
// What a check judges one by one: a frame by number and view, or a case by name and method.
#pragma once

#include <string>
#include <tuple>

namespace tonetool::sequence {

struct Item {
    int frame = 0;                ///< of a named case without # in its pattern: 0
    std::string view{};           ///< empty where the pattern has no %V or %v
    std::string name{}, method{}; ///< of %N and %M

    bool named() const { return !name.empty() || !method.empty(); }
    bool operator==(const Item& o) const {
        return frame == o.frame && view == o.view && name == o.name && method == o.method;
    }
    bool operator!=(const Item& o) const { return !(*this == o); }
    /// By name and method, as bytes; frames of one by view first, those without a name by number.
    bool operator<(const Item& o) const {
        if (std::tie(name, method) != std::tie(o.name, o.method))
            return std::tie(name, method) < std::tie(o.name, o.method);
        return named() ? std::tie(view, frame) < std::tie(o.view, o.frame)
                       : std::tie(frame, view) < std::tie(o.frame, o.view);
    }
};

/// The frames whose rules over time hold together: those of one name, method and view.
struct Series {
    std::string name, method, view;
    bool operator<(const Series& o) const {
        return std::tie(name, method, view) < std::tie(o.name, o.method, o.view);
    }
    bool operator==(const Series& o) const {
        return std::tie(name, method, view) == std::tie(o.name, o.method, o.view);
    }
};
inline Series series_of(const Item& item) {
    return {item.name, item.method, item.view};
}

/// "5 left"; of a case "hair/long [method] frame 5 left".
inline std::string item_name(const Item& item) {
    const std::string view = item.view.empty() ? "" : " " + item.view;
    if (!item.named())
        return std::to_string(item.frame) + view;
    const std::string method = item.method.empty() ? ""
                               : item.name.empty() ? "[" + item.method + "]"
                                                   : " [" + item.method + "]";
    return item.name + method + (item.frame == 0 ? "" : " frame " + std::to_string(item.frame)) +
           view;
}

/// "frame 5 left", "case hair/long".
inline std::string item_title(const Item& item) {
    return (item.named() ? "case " : "frame ") + item_name(item);
}

} // namespace tonetool::sequence

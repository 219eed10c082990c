// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/suite/suite_file.h"

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

#include "imagebuf/pixels/names.h"
#include "sequence/suite/toml_versions.h"

namespace tonetool::sequence {

namespace {

using Value = TomlValue;

constexpr char kFormatKey[] = "tonetool-suite";

// As toml11 lays a message out, without the word before it.
std::string laid_out_error(const std::string& what, const Value& at, const std::string& comment) {
    const std::string start = "[error] ";
    std::string text = toml_message(what, at, comment);
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    return text.compare(0, start.size(), start) == 0 ? text.substr(start.size()) : text;
}

// "[error] toml::insert_value: value ("fail") already exists." without the names of functions.
std::string without_library_names(const std::string& text) {
    static const std::regex names("toml::[a-z_]+: ?|\\[error\\] ?");
    return std::regex_replace(text, names, "");
}

[[noreturn]] void refuse(const std::string& what, const Value& at, const std::string& comment) {
    throw std::runtime_error(laid_out_error(what, at, comment));
}

int line_of(const Value& value) {
    return int(toml_line(value));
}

// "did you mean fail?", or the keys that there are.
std::string meant_key(const std::string& key, const std::vector<std::string>& valid) {
    std::string all;
    for (const std::string& one : valid) {
        if (edit_distance(key, one) <= 2)
            return "did you mean " + one + "?";
        all += (all.empty() ? "valid: " : ", ") + one;
    }
    return all;
}

void refuse_unknown_keys(const Value& table, const std::vector<std::string>& valid) {
    const Value* first = nullptr;
    std::string unknown;
    for (const auto& [key, value] : table.as_table())
        if (std::find(valid.begin(), valid.end(), key) == valid.end() &&
            (!first || line_of(value) < line_of(*first))) {
            first = &value;
            unknown = key;
        }
    if (first)
        refuse("a suite has no key \"" + unknown + "\"", *first, meant_key(unknown, valid));
}

std::string text_in(const Value& table, const std::string& key) {
    if (!table.contains(key))
        return "";
    const Value& value = table.at(key);
    if (!value.is_string()) {
        const bool limits = key == "fail" || key == "warn";
        refuse(key + " is a text", value,
               limits ? key + " = \"mean=0.3,p99.9=0.6\"" : key + " = \"...\"");
    }
    if (toml_text(value).find_first_not_of(" \t\r\n") == std::string::npos)
        refuse(key + " is empty", value, "leave the key out");
    return toml_text(value);
}

SuiteRow row_from(const Value& from) {
    static const std::vector<std::string> keys{"name",  "method", "check",  "fail", "warn",
                                               "layer", "mask",   "ignore", "skip", "why"};
    refuse_unknown_keys(from, keys);
    SuiteRow row;
    row.line = line_of(from);
    row.shown = laid_out_error("this row matches no case", from, "");
    for (const std::string& key : keys) {
        const std::string text = text_in(from, key);
        if (text.empty())
            continue;
        if (key == "name")
            row.name = CaseGlob(text);
        else if (key == "method")
            row.method = CaseGlob(text);
        else
            row.settings[key] = {text, row.line};
    }
    for (const char* key : {"mask", "ignore"})
        if (row.settings.count(key) > 0 && row.settings.count("why") == 0)
            refuse(std::string(key) + " needs why", from.at(key),
                   "why = \"what is not compared, and why\"");
    if (row.settings.empty())
        refuse("this row says nothing of its cases", from, "valid: fail, warn, layer, skip, ...");
    return row;
}

void check_format(const Value& from, const std::string& file) {
    if (!from.contains(kFormatKey))
        throw std::runtime_error("\"" + file + "\" is no suite: its first line is " + kFormatKey +
                                 " = 1");
    const Value& format = from.at(kFormatKey);
    if (!format.is_integer() || format.as_integer() != 1)
        refuse("a suite of another format", format, "this program reads 1");
}

Suite suite_of(const Value& from, const std::string& file) {
    check_format(from, file);
    refuse_unknown_keys(from,
                        {kFormatKey, "name", "reference", "test", "check", "attribute", "case"});
    Suite suite;
    suite.file = file;
    suite.folder = file.substr(0, file.rfind('/') + 1);
    suite.name = text_in(from, "name");
    suite.reference = text_in(from, "reference");
    suite.test = text_in(from, "test");
    suite.check = text_in(from, "check");
    for (const char* key : {"test", "check"})
        if (!from.contains(key))
            throw std::runtime_error("\"" + file + "\" has no " + key);
    suite.test_line = line_of(from.at("test"));
    if (from.contains("attribute")) {
        const Value& attribute = from.at("attribute");
        if (!attribute.is_boolean())
            refuse("attribute is true or false", attribute, "attribute = true");
        suite.attribute = attribute.as_boolean();
    }
    if (!from.contains("case"))
        return suite;
    const Value& rows = from.at("case");
    const bool tables =
        rows.is_array() && std::all_of(rows.as_array().begin(), rows.as_array().end(),
                                       [](const Value& row) { return row.is_table(); });
    if (!tables)
        refuse("case is a list of rows", rows, "[[case]]");
    for (const Value& row : rows.as_array())
        suite.rows.push_back(row_from(row));
    return suite;
}

} // namespace

SuiteSettings Suite::settings_of(const std::string& of_name, const std::string& method) const {
    SuiteSettings settings;
    for (const SuiteRow& row : rows)
        if (row.name.fits(of_name) && row.method.fits(method))
            for (const auto& [key, setting] : row.settings)
                settings[key] = setting;
    return settings;
}

std::string Suite::unmatched(const std::vector<std::pair<std::string, std::string>>& cases) {
    std::set<std::string> names, methods;
    for (const auto& [of_case, method] : cases) {
        names.insert(of_case);
        methods.insert(method);
    }
    for (SuiteRow& row : rows) {
        row.name.look_at(names);
        row.method.look_at(methods);
        const bool any = std::any_of(cases.begin(), cases.end(), [&](const auto& one) {
            return row.name.fits(one.first) && row.method.fits(one.second);
        });
        if (!any) {
            const std::string meant = meant_case(row.name.text(), {names.begin(), names.end()});
            return row.shown + (meant.empty() ? "" : "\n" + meant);
        }
    }
    return "";
}

std::string Suite::path(const std::string& of_name) const {
    return of_name.empty() || of_name.front() == '/' ? of_name : folder + of_name;
}

Suite suite_from(const std::string& text, const std::string& file) {
    try {
        std::istringstream stream(text);
        return suite_of(parse_toml(stream, file), file);
    } catch (const toml::exception& problem) {
        throw std::runtime_error(without_library_names(problem.what()));
    } catch (const std::out_of_range& problem) {
        throw std::runtime_error("\"" + file + "\" is no suite: " + problem.what());
    }
}

} // namespace tonetool::sequence

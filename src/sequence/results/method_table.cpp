// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/method_table.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "imagebuf/pixels/utf8.h"
#include "sequence/results/measuring.h"
#include "text/printable.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

// ---- numbers

struct NamedValue {
    std::string name; ///< "hdrflip.mean", of the second of the same command "hdrflip#2.mean"
    double value;
    bool higher_is_better;
};

std::vector<NamedValue> values_of(const FrameResult& frame) {
    std::vector<NamedValue> all;
    std::map<std::string, int> seen;
    for (const Measurement& measured : frame.measurements) {
        const int number = ++seen[measured.command];
        const std::string start =
            measured.command + (number > 1 ? "#" + std::to_string(number) : "") + ".";
        for (const auto& [name, value] : measured.quantities)
            all.push_back({start + name, value, higher_is_better(measured.command, name)});
    }
    return all;
}

struct TableCell {
    std::vector<double> values;
    bool whole = true;    ///< each frame has a value
    bool skipped = false; ///< a frame has none because the suite skips it

    bool is_there() const { return whole && !values.empty(); }
    double mean() const {
        double sum = 0;
        for (const double value : values)
            sum += value;
        return sum / double(values.size());
    }
    /// Of a sample.
    double deviation() const {
        const double middle = mean();
        double sum = 0;
        for (const double value : values)
            sum += (value - middle) * (value - middle);
        return std::sqrt(sum / double(values.size() - 1));
    }
};

struct TableColumn {
    std::string title, quantity;
    std::optional<std::string> method{}; ///< nullopt: a column of the quantity
    bool higher_is_better = false;
};

struct NumberTable {
    std::vector<std::string> names;
    std::vector<TableColumn> columns;
    std::vector<std::vector<TableCell>> rows;
    std::vector<std::optional<double>> means; ///< of the columns that have all rows
};

std::vector<std::string> all_quantities(const ShotResult& shot, std::map<std::string, bool>& up) {
    std::vector<std::string> names;
    for (const FrameResult& frame : shot.frames)
        for (const NamedValue& one : values_of(frame))
            if (up.emplace(one.name, one.higher_is_better).second)
                names.push_back(one.name);
    return names;
}

std::vector<std::string> methods_of(const ShotResult& shot) {
    std::set<std::string> methods;
    for (const FrameResult& frame : shot.frames)
        if (!frame.method.empty())
            methods.insert(frame.method);
    return {methods.begin(), methods.end()};
}

std::vector<TableColumn> columns_of(const ShotResult& shot, const MethodTableOptions& options) {
    std::map<std::string, bool> up;
    const std::vector<std::string> known = all_quantities(shot, up);
    const std::vector<std::string> there = methods_of(shot);
    std::vector<std::string> asked = options.quantities;
    if (asked.empty() && !known.empty())
        asked = there.empty() ? known : std::vector<std::string>{known.front()};
    for (const std::string& quantity : asked)
        if (!known.empty() && up.count(quantity) == 0) {
            throw std::runtime_error("no case has the quantity \"" + quantity +
                                     "\" (valid: " + OIIO::Strutil::join(known, ", ") + ")");
        }
    if (!there.empty() && asked.size() > 1) {
        throw std::runtime_error("over methods a table has one quantity, not " +
                                 std::to_string(asked.size()) + " (valid: quantity=" + asked[0] +
                                 ")");
    }
    std::vector<TableColumn> columns;
    if (there.empty()) {
        for (const std::string& quantity : asked)
            columns.push_back({quantity, quantity, std::nullopt, up[quantity]});
        return columns;
    }
    for (const std::string& method : options.methods.empty() ? there : options.methods) {
        if (std::find(there.begin(), there.end(), method) == there.end())
            throw std::runtime_error("there is no method \"" + method +
                                     "\" (valid: " + OIIO::Strutil::join(there, ", ") + ")");
        if (std::any_of(columns.begin(), columns.end(),
                        [&](const TableColumn& column) { return column.method == method; }))
            throw std::runtime_error("the method \"" + method + "\" is named twice");
        const std::string quantity = asked.empty() ? "" : asked.front();
        columns.push_back({method, quantity, method, up[quantity]});
    }
    return columns;
}

TableCell cell_of(const std::vector<const FrameResult*>& frames, const TableColumn& column) {
    TableCell cell;
    for (const FrameResult* frame : frames) {
        if (column.method && frame->method != *column.method)
            continue;
        const std::vector<NamedValue> all = values_of(*frame);
        const auto found = std::find_if(all.begin(), all.end(), [&](const NamedValue& one) {
            return one.name == column.quantity;
        });
        const bool measured = found != all.end() && frame->status <= Status::Failed;
        cell.whole = cell.whole && measured;
        cell.skipped = cell.skipped || frame->status == Status::Skipped;
        if (measured)
            cell.values.push_back(found->value);
    }
    return cell;
}

NumberTable table_of(const ShotResult& shot, const MethodTableOptions& options) {
    if (!is_named(shot))
        throw std::runtime_error(kTableNeedsNames);
    NumberTable table;
    table.columns = columns_of(shot, options);
    std::map<std::string, std::vector<const FrameResult*>> names;
    for (const FrameResult& frame : shot.frames)
        names[frame.name].push_back(&frame);
    for (const auto& [name, frames] : names) {
        table.names.push_back(name);
        std::vector<TableCell>& row = table.rows.emplace_back();
        for (const TableColumn& column : table.columns)
            row.push_back(cell_of(frames, column));
    }
    for (size_t c = 0; c < table.columns.size(); ++c) {
        double sum = 0;
        bool whole = true;
        for (const auto& row : table.rows) {
            whole = whole && row[c].is_there();
            sum += whole ? row[c].mean() : 0;
        }
        table.means.push_back(whole ? std::optional(sum / double(table.rows.size()))
                                    : std::nullopt);
    }
    return table;
}

// ---- texts

std::string digits_of(double value, int digits) {
    return format("{:.{}f}", value, digits);
}

// Which numbers of a row are the best: of methods, whose numbers are of one kind. A reader takes
// for equal what is printed with the same digits.
std::vector<bool> best_of(const std::vector<std::optional<double>>& row,
                          const std::vector<TableColumn>& columns, int digits) {
    std::vector<bool> best(row.size(), false);
    std::optional<double> most;
    for (const auto& value : row)
        if (value && !std::isnan(*value))
            most = !most                         ? *value
                   : columns[0].higher_is_better ? std::max(*most, *value)
                                                 : std::min(*most, *value);
    if (most && std::isinf(*most) && (*most < 0) == columns[0].higher_is_better)
        return best; // all are as bad as can be
    for (size_t i = 0; i < row.size() && most; ++i)
        best[i] =
            columns[i].method && row[i] && digits_of(*row[i], digits) == digits_of(*most, digits);
    return best;
}

struct TableWords {
    const char *bold, *bold_end, *deviation, *nothing, *minus, *infinity;
};

std::string number_text(double value, int digits, const TableWords& words) {
    const std::string size =
        std::isinf(value) ? words.infinity : digits_of(std::abs(value), digits);
    return (std::signbit(value) && !std::isnan(value) ? words.minus : "") + size;
}

std::string cell_text(const TableCell& cell, bool best, int digits, const TableWords& words) {
    if (!cell.is_there())
        return words.nothing;
    std::string text = number_text(cell.mean(), digits, words);
    if (cell.values.size() > 1)
        text += words.deviation + number_text(cell.deviation(), digits, words);
    return best ? words.bold + text + words.bold_end : text;
}

// "hdrflip.mean, lower is better": of a table of methods.
std::string caption_of(const NumberTable& table) {
    const TableColumn& first = table.columns.front();
    return first.method
               ? first.quantity + (first.higher_is_better ? ", higher" : ", lower") + " is better"
               : "";
}

std::vector<std::string> texts_of_row(const NumberTable& table, const std::vector<TableCell>& row,
                                      int digits, const TableWords& words) {
    std::vector<std::optional<double>> values;
    for (const TableCell& cell : row)
        values.push_back(cell.is_there() ? std::optional(cell.mean()) : std::nullopt);
    const std::vector<bool> best = best_of(values, table.columns, digits);
    std::vector<std::string> texts;
    for (size_t i = 0; i < row.size(); ++i)
        texts.push_back(cell_text(row[i], best[i], digits, words));
    return texts;
}

std::vector<TableCell> mean_row(const NumberTable& table) {
    std::vector<TableCell> row;
    for (const auto& mean : table.means)
        row.push_back(mean ? TableCell{{*mean}} : TableCell{});
    return row;
}

std::string escaped_for(const std::string& text, const std::map<char, std::string>& escapes) {
    std::string safe;
    for (const char c : printable_lines(valid_utf8(text))) {
        const auto found = escapes.find(c);
        safe += found != escapes.end()   ? found->second
                : c == '\n' || c == '\r' ? " "
                                         : std::string(1, c);
    }
    return safe;
}

std::string markdown(const NumberTable& table, int digits) {
    const TableWords words{"**", "**", " \u00b1 ", "\u2013", "-", "inf"};
    const auto safe = [](const std::string& text) {
        return escaped_for(text, {{'|', "\\|"},
                                  {'<', "&lt;"},
                                  {'>', "&gt;"},
                                  {'&', "&amp;"},
                                  {'*', "\\*"},
                                  {'`', "\\`"},
                                  {'\\', "\\\\"}});
    };
    const std::string caption = caption_of(table);
    std::string text = (caption.empty() ? "" : safe(caption) + "\n\n") + "| |", rule = "|---|";
    for (const TableColumn& column : table.columns) {
        text += " " + safe(column.title) + " |";
        rule += "--:|";
    }
    text += "\n" + rule + "\n";
    const auto put = [&](const std::string& name, const std::vector<TableCell>& row) {
        text += "| " + name + " |";
        for (const std::string& cell : texts_of_row(table, row, digits, words))
            text += " " + cell + " |";
        text += "\n";
    };
    for (size_t i = 0; i < table.rows.size(); ++i)
        put(safe(table.names[i]), table.rows[i]);
    put("mean", mean_row(table));
    return text;
}

std::string latex(const NumberTable& table, int digits) {
    const TableWords words{"\\textbf{", "}", " $\\pm$ ", "--", "$-$", "$\\infty$"};
    const auto safe = [](const std::string& text) {
        return escaped_for(text, {{'\\', "\\textbackslash{}"},
                                  {'{', "\\{"},
                                  {'}', "\\}"},
                                  {'_', "\\_"},
                                  {'^', "\\textasciicircum{}"},
                                  {'~', "\\textasciitilde{}"},
                                  {'&', "\\&"},
                                  {'%', "\\%"},
                                  {'#', "\\#"},
                                  {'$', "\\$"}});
    };
    const std::string caption = caption_of(table);
    std::string text = (caption.empty() ? "" : "% " + printable_lines(valid_utf8(caption)) + "\n") +
                       "% needs \\usepackage{booktabs}\n\\begin{tabular}{l" +
                       std::string(table.columns.size(), 'r') + "}\n\\toprule\n";
    for (const TableColumn& column : table.columns)
        text += " & " + safe(column.title);
    text += " \\\\\n\\midrule\n";
    const auto put = [&](const std::string& name, const std::vector<TableCell>& row) {
        text += name;
        for (const std::string& cell : texts_of_row(table, row, digits, words))
            text += " & " + cell;
        text += " \\\\\n";
    };
    for (size_t i = 0; i < table.rows.size(); ++i)
        put(safe(table.names[i]), table.rows[i]);
    text += "\\midrule\n";
    put("mean", mean_row(table));
    return text + "\\bottomrule\n\\end{tabular}\n";
}

std::string comma_separated(const NumberTable& table) {
    const auto safe = [](const std::string& text) {
        const bool formula =
            !text.empty() && std::string("=+-@\t\r").find(text[0]) != std::string::npos;
        const std::string plain = (formula ? "'" : "") + printable_lines(valid_utf8(text));
        return plain.find_first_of(",\"\r\n") == std::string::npos
                   ? plain
                   : "\"" + OIIO::Strutil::replace(plain, "\"", "\"\"", true) + "\"";
    };
    std::string text = "name";
    for (const TableColumn& column : table.columns)
        text += "," + safe(column.title);
    text += "\n";
    const auto put = [&](const std::string& name, const std::vector<TableCell>& row) {
        text += name;
        for (const TableCell& cell : row)
            text += "," + (cell.is_there() ? format("{:.6g}", cell.mean()) : std::string());
        text += "\n";
    };
    for (size_t i = 0; i < table.rows.size(); ++i)
        put(safe(table.names[i]), table.rows[i]);
    put("mean", mean_row(table));
    return text;
}

} // namespace

TableFormat table_format(const std::string& file) {
    const auto ends = [&](const char* with) { return OIIO::Strutil::iends_with(file, with); };
    if (!ends(".md") && !ends(".tex") && !ends(".csv"))
        throw std::runtime_error("--table: \"" + file +
                                 "\" has no extension of a table (valid: .md, "
                                 ".tex, .csv)");
    return ends(".md")    ? TableFormat::Markdown
           : ends(".tex") ? TableFormat::LaTeX
                          : TableFormat::Csv;
}

std::string method_table(const ShotResult& shot, const MethodTableOptions& options,
                         TableFormat format) {
    const NumberTable table = table_of(shot, options);
    return format == TableFormat::Markdown ? markdown(table, options.digits)
           : format == TableFormat::LaTeX  ? latex(table, options.digits)
                                           : comma_separated(table);
}

std::string lacking_in_table(const ShotResult& shot, const MethodTableOptions& options) {
    const NumberTable table = table_of(shot, options);
    std::vector<std::string> lacking;
    for (size_t i = 0; i < table.rows.size(); ++i)
        for (size_t c = 0; c < table.columns.size(); ++c)
            if (!table.rows[i][c].is_there() && !table.rows[i][c].skipped)
                lacking.push_back(table.names[i] + (table.columns[c].method
                                                        ? " [" + table.columns[c].title + "]"
                                                        : " (" + table.columns[c].title + ")"));
    return OIIO::Strutil::join(lacking, ", ");
}

} // namespace tonetool::sequence

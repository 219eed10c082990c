// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_files.h"

#include <stdexcept>

#include "sequence/report/report_page.h"
#include "sequence/report/report_sheet.h"
#include "tonetool/write.h"

namespace tonetool::sequence {

std::vector<std::string> write_reports(const ShotResult& shot, const PictureStore& pictures,
                                       const CheckFiles& files, const PageLimits& limits,
                                       std::vector<std::string>& errors) {
    std::vector<std::string> complaints;
    if (!pictures.complaint().empty())
        complaints.push_back(pictures.complaint());
    const auto page = files.find("report"), sheet = files.find("contactsheet");
    if (page != files.end())
        attempt(errors, [&] { write_text(report_page(shot, pictures, limits), page->second); });
    if (sheet != files.end()) {
        std::string warning;
        attempt(errors, [&] {
            std::string why;
            if (!write_image(contact_sheet(shot, pictures, warning), sheet->second, why))
                throw std::runtime_error(why);
        });
        if (!warning.empty())
            complaints.push_back(warning);
    }
    return complaints;
}

} // namespace tonetool::sequence

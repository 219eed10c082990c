// SPDX-License-Identifier: BSD-3-Clause
// The files of --images: of each case that did not pass its reference, test and error map.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "sequence/report/case_pictures.h"
#include "sequence/results/case_files.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// The folder of --images. Each of its files says in its header which measurement it shows, so that
/// a file of an earlier run is not taken for one of this, and others' files are told from ours.
class CaseImages {
public:
    /// `still`: the check is of one pair, which has no name but that of its file.
    CaseImages(std::string folder, bool still);

    /// Where the images of a case are or would be. Names are those of the cases, and different
    /// where those are.
    CaseFiles::Of files(const FrameResult& frame) const;

    /// Whether a frame with this status gets images.
    static bool wants(Status status) { return status > Status::Measured; }
    /// Writes each whole or not at all. Throws a runtime_error.
    void write(const FrameResult& frame, const CasePictures& pictures) const;
    /// Whether there is an image of this measurement.
    bool has(const FrameResult& frame) const;

    /// At the end of a check: removes our images of its cases that passed, and of other
    /// measurements of them; what remains. Files of cases that the check does not have stay as they
    /// are. Throws a runtime_error if one cannot be removed.
    CaseFiles settle(const ShotResult& shot) const;

private:
    std::string m_folder;
    bool m_still;
};

/// How many frames were measured, did not pass, and have no image there.
size_t lacking_images(const ShotResult& shot, const CaseFiles& files);

} // namespace tonetool::sequence

// SPDX-License-Identifier: BSD-3-Clause
// Commands that make an image from images: one kernel each, run over subimages and MIP levels.
#pragma once

#include <OpenImageIO/imagebufalgo.h>
#include <functional>

#include "chain/images/windows.h"
#include "chain/session/call.h"
#include "chain/session/session.h"
#include "text/error.h"

namespace tonetool::chain {

namespace IBA = OIIO::ImageBufAlgo;
using Floats = std::vector<float>;
inline constexpr Range kAnyNumberAtAll{-3.4e38, 3.4e38};
inline constexpr Range kAnyInteger{-2147483648.0, 2147483647.0};

/// What a kernel works on: one MIP level of one subimage of the images that were popped, with the
/// arguments and modifiers as it needs them.
struct Op {
    Session& session;
    const Call& call;
    OIIO::ImageBuf& dst;
    std::vector<const OIIO::ImageBuf*> src;
    int subimage = 0;
    bool unchanged = false; ///< set by a kernel that has nothing to do

    const OIIO::ImageBuf& a() const { return *src.at(0); }
    const OIIO::ImageBuf& b() const { return *src.at(1); }
    const OIIO::ImageBuf& c() const { return *src.at(2); }

    float number(size_t argument) const {
        return float(call.number_argument(argument, kAnyNumberAtAll));
    }
    float number(const std::string& key, float otherwise) const {
        return float(call.number(key, kAnyNumberAtAll).value_or(double(otherwise)));
    }
    int integer(size_t argument) const { return call.integer_argument(argument, kAnyInteger); }
    int integer(const std::string& key, int otherwise) const {
        return call.integer(key, kAnyInteger).value_or(otherwise);
    }
    bool flag(const std::string& key, bool otherwise = false) const {
        return call.flag(key, otherwise);
    }
    std::string text(const std::string& key, const std::string& otherwise = "") const {
        return call.text(key).value_or(otherwise);
    }
    /// "V" for all channels, or "V,V,...", the rest of them `rest`.
    Floats per_channel(const std::string& what, const std::string& list, float rest) const;
    /// The same of so many values instead of one for each channel.
    Floats per_value(const std::string& what, const std::string& list, float rest,
                     size_t count) const;
    Floats constants(float rest) const { return per_channel("VALUES", call.argument(0), rest); }
    Floats values(const std::string& key, float rest) const;
    /// Numbers with commas between them.
    Floats list(const std::string& what, const std::string& words) const;
};

using Kernel = bool (*)(Op&);

// Kernels that are functions of OpenImageIO on one image, on two, and on one and constants, of
// which those that are not given are `Rest`.
using OfOne = bool (*)(OIIO::ImageBuf&, const OIIO::ImageBuf&, OIIO::ROI, int);
using OfTwo = bool (*)(OIIO::ImageBuf&, OIIO::Image_or_Const, OIIO::Image_or_Const, OIIO::ROI, int);
template <OfOne Function>
bool of_one(Op& op) {
    return Function(op.dst, op.a(), {}, 0);
}
template <OfTwo Function>
bool of_two(Op& op) {
    return Function(op.dst, op.a(), op.b(), {}, 0);
}
template <OfTwo Function, int Rest>
bool of_constants(Op& op) {
    return Function(op.dst, op.a(), op.constants(Rest), {}, 0);
}

/// Which of an image's parts a command makes: without -a the first subimage only. Levels: with -a
/// MIP levels stay.
enum class Scope { Largest, Levels };

/// A command that pops some images and pushes the one that its kernel makes, which is named after
/// it: Row::operation() gives another name, "" none.
Row on_pixels(const std::string& usage, int images, std::string help, Kernel kernel,
              Scope scope = Scope::Largest);

using Edit = void (*)(OIIO::ImageSpec&, const Call&, Session&);

/// A command that changes headers and no pixels.
Row on_headers(const std::string& usage, std::string help, Edit edit);

/// The subimages that -a, allsubimages= and subimages= choose.
struct Chosen {
    size_t count = 1; ///< subimages of the result
    std::vector<bool> active;
};
Chosen chosen_subimages(const Session& session, const Call& call, const Image& image);

/// Runs a kernel over those subimages of call.images and pushes the result.
void run_kernel(Session& session, const Call& call, const Kernel& kernel, Scope scope);

/// The image with other headers.
ImagePtr with_headers(const Image& image, const Chosen& chosen,
                      const std::function<void(OIIO::ImageSpec&)>& edit);

/// adjust_window for the command. False where --compat let something pass.
bool adjust_window(Session& session, const Call& call, const std::string& text, Geometry allowed,
                   OIIO::ROI& window);

/// Takes that many images from the stack (0: all there are), the deepest first.
std::vector<ImagePtr> take_images(Session& session, size_t count);

/// --noise and --pattern noise: onto the pixels of dst.
bool add_noise(Op& op, bool to_blank);
Modifiers noise_modifiers();

} // namespace tonetool::chain

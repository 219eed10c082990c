#include "imagebuf/view_light.h"

namespace tonetool {

kernels::ToneRows DisplayLight::baked() const {
    return exact();
}

} // namespace tonetool

// OpenImageIO's thread pool as the rooms below see it.
#pragma once

#include "imagebuf/oiio_compat.h"
#include "kernels/views.h"

namespace tonetool {

/// 0 threads: OpenImageIO's "threads" attribute. Inside a pool thread everything runs serially.
inline kernels::ParallelFor make_parallel(int nthreads) {
    return [nthreads](int64_t count, const std::function<void(int64_t)>& task) {
        oiio::parallel_tasks(count, nthreads, task);
    };
}

} // namespace tonetool

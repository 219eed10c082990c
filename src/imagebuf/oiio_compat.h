// All that differs between OpenImageIO 2.4, 2.5 and 3.x for this project.
//
// 2.4 and 2.5: paropt and parallel_for_chunked as used here exist; 3.x keeps both spellings.
// TypeDesc constants are named TypeFloat, TypeInt, TypeString in all three.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/oiioversion.h>
#include <OpenImageIO/parallel.h>
#include <functional>

#if OIIO_VERSION < 20400
#error "tonetool needs OpenImageIO 2.4 or newer"
#endif

namespace tonetool::oiio {

/// Runs task(i) for every i below count, one at a time per thread: tasks are coarse.
inline void parallel_tasks(int64_t count, int nthreads, const std::function<void(int64_t)>& task)
{
    OIIO::parallel_for_chunked(
        0, count, 1,
        [&task](int64_t begin, int64_t end) {
            for (int64_t i = begin; i < end; ++i)
                task(i);
        },
        OIIO::paropt(nthreads));
}

} // namespace tonetool::oiio

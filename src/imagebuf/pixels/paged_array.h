// SPDX-License-Identifier: BSD-3-Clause
// An array in mapped pages of its own: memory is committed when it is first written, and pages go
// back to the system without moving the rest.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <sys/mman.h>
#include <unistd.h>
#include <utility>

#include "imagebuf/pixels/allocation.h"

namespace tonetool {

inline void prefer_large_pages(void* pages, size_t bytes) {
#ifdef MADV_HUGEPAGE
    if (pages)
        ::madvise(pages, bytes, MADV_HUGEPAGE);
#else
    (void)pages, (void)bytes;
#endif
}

/// An array of plain numbers. Elements are not initialized; shrinking gives whole pages back.
template <class T>
class PagedArray {
public:
    using value_type = T;
    using const_iterator = const T*;

    PagedArray() = default;
    PagedArray(const PagedArray&) = delete;
    PagedArray& operator=(const PagedArray&) = delete;
    PagedArray(PagedArray&& other) noexcept { swap(other); }
    PagedArray& operator=(PagedArray&& other) noexcept {
        swap(other);
        return *this;
    }
    ~PagedArray() {
        if (m_data)
            ::munmap(m_data, m_capacity * sizeof(T));
    }

    void resize(size_t count) {
        if (count > m_capacity)
            grow(count);
        else if (count < m_size)
            release(count);
        m_size = count;
    }
    /// All of it will be written: larger pages take less time.
    void expect_all_written() { prefer_large_pages(m_data, m_capacity * sizeof(T)); }
    /// Moves `count` elements from `from` to the front; the others are lost.
    void keep(size_t from, size_t count) {
        if (from > 0 && count > 0)
            std::memmove(m_data, m_data + from, count * sizeof(T));
    }

    T* data() { return m_data; }
    const T* data() const { return m_data; }
    size_t size() const { return m_size; }
    bool empty() const { return m_size == 0; }
    T& operator[](size_t i) { return m_data[i]; }
    const T& operator[](size_t i) const { return m_data[i]; }
    const T* begin() const { return m_data; }
    const T* end() const { return m_data + m_size; }
    bool operator==(const PagedArray& o) const {
        return m_size == o.m_size && std::equal(begin(), end(), o.begin());
    }

private:
    void swap(PagedArray& other) noexcept {
        std::swap(m_data, other.m_data);
        std::swap(m_size, other.m_size);
        std::swap(m_capacity, other.m_capacity);
    }

    void grow(size_t count) {
        if (count > SIZE_MAX / 2 / sizeof(T))
            throw std::bad_alloc();
        expect_memory(count * sizeof(T));
        void* pages = ::mmap(nullptr, count * sizeof(T), PROT_READ | PROT_WRITE,
                             MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (pages == MAP_FAILED)
            throw std::bad_alloc();
        PagedArray larger;
        larger.m_data = static_cast<T*>(pages);
        larger.m_capacity = count;
        if (m_size > 0)
            std::memcpy(larger.m_data, m_data, m_size * sizeof(T));
        swap(larger);
    }

    void release(size_t count) {
        const auto page = size_t(::sysconf(_SC_PAGESIZE));
        const size_t used = (count * sizeof(T) + page - 1) / page * page;
        const size_t all = m_capacity * sizeof(T);
        if (used < all)
            ::madvise(reinterpret_cast<char*>(m_data) + used, all - used, MADV_DONTNEED);
    }

    T* m_data = nullptr;
    size_t m_size = 0, m_capacity = 0;
};

} // namespace tonetool

// Slots for the things that the ids of the C interface name. Looking up takes no lock, so that worlds of different
// threads do not wait for each other.
#pragma once

#include "lock.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace elastoon::c_interface {

template <class T>
class Table {
public:
    struct Key {
        std::uint32_t slot = 0, generation = 0;
    };

    Table() = default;
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;
    ~Table() {
        for (std::atomic<Block*>& block : blocks_) {
            delete block.load();
        }
    }

    /// The new thing's key; the null key where all slots are taken.
    Key add(std::unique_ptr<T> value) {
        const Lock lock(mutex_);
        if (free_.empty() && !grow()) {
            return {};
        }
        const std::uint32_t index = free_.back();
        free_.pop_back();
        Slot& slot = at(index);
        slot.value = std::move(value);
        const std::uint32_t generation = slot.generation.load(std::memory_order_relaxed) + 1;
        slot.generation.store(generation, std::memory_order_release);
        return {index + 1, generation};
    }

    /// Null if the key names nothing.
    [[nodiscard]] T* find(Key key) const {
        const std::uint32_t index = key.slot - 1;
        if (key.slot == 0 || key.slot > kBlockSize * kBlocks || key.generation % 2 == 0) {
            return nullptr;
        }
        const Block* block = blocks_[index / kBlockSize].load(std::memory_order_acquire);
        if (block == nullptr) {
            return nullptr;
        }
        const Slot& slot = (*block)[index % kBlockSize];
        return slot.generation.load(std::memory_order_acquire) == key.generation ? slot.value.get() : nullptr;
    }

    /// What the key named, which it names no longer; null if it named nothing.
    std::unique_ptr<T> remove(Key key) {
        const Lock lock(mutex_);
        if (find(key) == nullptr) {
            return nullptr;
        }
        Slot& slot = at(key.slot - 1);
        slot.generation.store(key.generation + 1, std::memory_order_release);
        std::unique_ptr<T> value = std::move(slot.value);
        free_.push_back(key.slot - 1);
        return value;
    }

    /// Calls visit(thing) for each.
    template <class Visit>
    void forEach(Visit&& visit) const {
        const Lock lock(mutex_);
        for (std::uint32_t index = 0; index < used_blocks_ * kBlockSize; ++index) {
            const Slot& slot = (*blocks_[index / kBlockSize].load())[index % kBlockSize];
            if (slot.value != nullptr) {
                visit(*slot.value);
            }
        }
    }

private:
    static constexpr std::uint32_t kBlockSize = 256, kBlocks = 4096;

    struct Slot {
        std::unique_ptr<T> value;
        std::atomic<std::uint32_t> generation{0}; ///< odd while the slot is used
    };
    using Block = std::array<Slot, kBlockSize>;

    Slot& at(std::uint32_t index) { return (*blocks_[index / kBlockSize].load())[index % kBlockSize]; }

    bool grow() {
        if (used_blocks_ == kBlocks) {
            return false;
        }
        free_.reserve(std::size_t{kBlockSize} * (used_blocks_ + 1));
        auto block = std::make_unique<Block>();
        blocks_[used_blocks_].store(block.release(), std::memory_order_release);
        for (std::uint32_t i = kBlockSize; i-- > 0;) {
            free_.push_back(used_blocks_ * kBlockSize + i);
        }
        ++used_blocks_;
        return true;
    }

    std::array<std::atomic<Block*>, kBlocks> blocks_{};
    std::uint32_t used_blocks_ = 0;
    std::vector<std::uint32_t> free_;
    mutable Mutex mutex_;
};

} // namespace elastoon::c_interface

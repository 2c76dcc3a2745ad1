// A work group whose shader calls barrier() runs on fibers (POSIX ucontext), one for each block of lanes: a block that
// reaches the barrier gives way to the next, and when all have, or have ended, the first goes on.
#include "cpu_shaders/load/run_compute.h"

#include <sys/mman.h>
#include <ucontext.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "cpu_shaders/machine.h"

namespace twinshade {
namespace {

// Of a fiber, for each lane: twice what variables may take (translate/limits.h). Touched pages alone cost memory.
constexpr std::size_t kStackBytes = 256 << 10;

class Stack {
 public:
  explicit Stack(std::size_t bytes) : bytes_(bytes) {
    base_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (base_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "no memory for a work group");
  }
  ~Stack() { munmap(base_, bytes_); }
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;
  void* base() const { return base_; }
  std::size_t bytes() const { return bytes_; }

 private:
  const std::size_t bytes_;
  void* base_ = nullptr;
};

std::uint32_t lanes_of(Number number) {
  switch (number) {
    case Number::lanes4:
      return 4;
    case Number::lanes8:
      return 8;
    case Number::lanes16:
      return 16;
    default:
      return 1;
  }
}

const ShaderEntry& best_entry(const ShaderModule& module, Number number) {
  const ShaderEntry* best = nullptr;
  for (std::uint32_t i = 0; i < module.entry_count; ++i)
    if (module.entries[i].number == number && module.entries[i].isa <= machine_isa() &&
        (best == nullptr || module.entries[i].isa > best->isa))
      best = &module.entries[i];
  if (best == nullptr)
    throw UserError(std::string("shader ") + module.name + " has no code for the number type asked for");
  return *best;
}

// One work group at a time.
class WorkGroup {
 public:
  WorkGroup(const ShaderModule& module, const ShaderEntry& entry, const ShaderData& data)
      : module_(module), shade_(entry.shade), data_(data), lanes_(lanes_of(entry.number)) {
    const std::uint32_t size = module.local_size[0] * module.local_size[1] * module.local_size[2];
    shared_.resize((module.shared_bytes + 3) / 4);
    blocks_ = std::vector<Block>((size + lanes_ - 1) / lanes_);
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      Block& block = blocks_[k];
      const auto first = static_cast<std::uint32_t>(k) * lanes_;
      for (std::uint32_t i = 0; i < lanes_; ++i) block.live[i] = first + i < size ? ~0u : 0;
      block.group = this;
      block.where.first = first;
      block.where.shared = reinterpret_cast<std::byte*>(shared_.data());
      block.where.barrier = &WorkGroup::barrier;
      block.where.barrier_context = this;
      if (module.uses_barrier) block.stack = std::make_unique<Stack>(kStackBytes * lanes_);
    }
  }

  void run(const std::array<std::uint32_t, 3>& group, const std::array<std::uint32_t, 3>& count) {
    std::fill(shared_.begin(), shared_.end(), 0u);
    for (Block& block : blocks_) {
      std::copy(group.begin(), group.end(), block.where.group);
      std::copy(count.begin(), count.end(), block.where.group_count);
      if (module_.uses_barrier)
        start(block);
      else
        shade(block);
    }
    while (std::any_of(blocks_.begin(), blocks_.end(), [](const Block& b) { return b.running; }))
      for (Block& block : blocks_)
        if (block.running) {
          resume(block);
          if (failure_) std::rethrow_exception(failure_);
        }
  }

 private:
  struct Block {
    alignas(64) std::uint32_t live[16] = {}, kept[16] = {};
    ComputeCall where{};
    WorkGroup* group = nullptr;
    std::unique_ptr<Stack> stack;
    ucontext_t context{};
    bool running = false;
  };

  void shade(Block& block) {
    ShadeCall call{};
    call.count = lanes_;
    call.stride = 16;
    call.live = block.live;
    call.kept = block.kept;
    call.compute = &block.where;
    shade_(data_, call);
  }

  void start(Block& block) {
    getcontext(&block.context);
    block.context.uc_stack.ss_sp = block.stack->base();
    block.context.uc_stack.ss_size = block.stack->bytes();
    block.context.uc_link = &scheduler_;
    // makecontext passes ints only.
    const auto address = reinterpret_cast<std::uintptr_t>(&block);
    makecontext(&block.context, reinterpret_cast<void (*)()>(&WorkGroup::enter), 2,
                static_cast<unsigned>(address >> 32), static_cast<unsigned>(address));
    block.running = true;
  }

  static void enter(unsigned high, unsigned low) {
    auto& block = *reinterpret_cast<Block*>(static_cast<std::uintptr_t>(high) << 32 | low);
    try {
      block.group->shade(block);
    } catch (...) {  // an endless loop: it cannot unwind beyond its stack
      block.group->failure_ = std::current_exception();
    }
    block.running = false;
  }

  void resume(Block& block) {
    current_ = &block;
    swapcontext(&scheduler_, &block.context);
  }

  static void barrier(void* context) {
    auto& group = *static_cast<WorkGroup*>(context);
    swapcontext(&group.current_->context, &group.scheduler_);
  }

  const ShaderModule& module_;
  const ShadeFunction shade_;
  const ShaderData& data_;
  const std::uint32_t lanes_;
  std::vector<std::uint32_t> shared_;
  std::vector<Block> blocks_;
  ucontext_t scheduler_{};
  Block* current_ = nullptr;
  std::exception_ptr failure_;
};

}  // namespace

void run_compute(const ShaderModule& module, Number number, const ShaderData& data,
                 const std::array<std::uint32_t, 3>& groups) {
  if (module.local_size[0] == 0) throw UserError(std::string("shader ") + module.name + " is no compute shader");
  WorkGroup group(module, best_entry(module, number), data);
  for (std::uint32_t z = 0; z < groups[2]; ++z)
    for (std::uint32_t y = 0; y < groups[1]; ++y)
      for (std::uint32_t x = 0; x < groups[0]; ++x) group.run({x, y, z}, groups);
}

}  // namespace twinshade

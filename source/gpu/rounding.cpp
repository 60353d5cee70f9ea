#include "gpu/rounding.h"

#include <bit>
#include <cassert>
#include <initializer_list>
#include <map>
#include <set>
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp11>

namespace strandlab {
namespace {

constexpr size_t header_words = 5, bound_word = 3;

struct Instruction {
    spv::Op op;
    std::span<const uint32_t> words;  // the first holds op and length
};

template <class Visit>
void for_each_instruction(std::span<const uint32_t> module, Visit&& visit) {
    for (size_t at = header_words; at < module.size();) {
        const uint32_t length = module[at] >> spv::WordCountShift;
        assert(length > 0 && at + length <= module.size());
        visit(Instruction{spv::Op(module[at] & spv::OpCodeMask), module.subspan(at, length)});
        at += length;
    }
}

/// A list of instructions that grows.
struct Section {
    void add(const Instruction& instruction) {
        words.insert(words.end(), instruction.words.begin(), instruction.words.end());
    }
    void add(spv::Op op, std::initializer_list<uint32_t> operands) {
        add(op, std::span<const uint32_t>(operands.begin(), operands.size()));
    }
    void add(spv::Op op, std::span<const uint32_t> operands) {
        const auto length = static_cast<uint32_t>(operands.size() + 1);
        words.push_back(length << spv::WordCountShift | static_cast<uint32_t>(op));
        words.insert(words.end(), operands.begin(), operands.end());
    }
    std::vector<uint32_t> words;
};

class Rounding {
  public:
    Rounding(std::span<const uint32_t> module, bool mends) : mends_(mends), bound_(module[bound_word]) {
        for_each_instruction(module, [&](const Instruction& instruction) { take(instruction); });
    }

    std::vector<uint32_t> module(std::span<const uint32_t> header) const {
        std::vector<uint32_t> all(header.begin(), header.end());
        all[bound_word] = bound_;
        for (const Section* section : {&head_, &marks_, &declarations_, &functions_})
            all.insert(all.end(), section->words.begin(), section->words.end());
        return all;
    }

  private:
    /// Modules are in this order: names and marks, types and constants, functions.
    void take(const Instruction& i) {
        if (i.op == spv::Op::OpFunction) in_functions_ = true;
        if (i.op == spv::Op::OpTypeVoid) in_head_ = false;  // what glslang begins with
        if (in_functions_) {
            rewrite(i);
        } else if (in_head_) {
            note_head(i);
            head_.add(i);
        } else {
            note_type(i);
            declarations_.add(i);
        }
    }

    void note_head(const Instruction& i) {
        if (i.op == spv::Op::OpExtInstImport) built_in_ = i.words[1];  // GLSL.std.450 is the only one
        if (i.op == spv::Op::OpDecorate && spv::Decoration(i.words[2]) == spv::Decoration::NoContraction)
            marked_.insert(i.words[1]);
    }

    void note_type(const Instruction& i) {
        if (i.op == spv::Op::OpTypeBool) bools_[1] = i.words[1];
        if (i.op == spv::Op::OpTypeFloat && i.words[2] == 32) {
            scalar_ = i.words[1];
            floats_[scalar_] = 1;
        }
        if (i.op != spv::Op::OpTypeVector) return;
        if (floats_.count(i.words[2]) != 0) floats_[i.words[1]] = i.words[3];
        if (bools_.count(1) != 0 && bools_[1] == i.words[2]) bools_[i.words[3]] = i.words[1];
    }

    void rewrite(const Instruction& i) {
        const bool is_float = i.words.size() > 3 && floats_.count(i.words[1]) != 0;
        switch (is_float ? i.op : spv::Op::OpNop) {
            case spv::Op::OpFAdd:
            case spv::Op::OpFSub:
            case spv::Op::OpFMul:
            case spv::Op::OpVectorTimesScalar: mark(i.words[2]); return functions_.add(i);
            case spv::Op::OpFDiv:
                if (mends_) return quotient(i.words[1], i.words[2], i.words[3], i.words[4]);
                mark(i.words[2]);
                return functions_.add(i);
            case spv::Op::OpExtInst:
                if (i.words[3] == built_in_ && i.words[4] == GLSLstd450FMix)
                    return mix(i.words[1], i.words[2], i.words[5], i.words[6], i.words[7]);
                if (mends_ && i.words[3] == built_in_ && i.words[4] == GLSLstd450Sqrt)
                    return root(i.words[1], i.words[2], i.words[5]);
                return functions_.add(i);
            default: return functions_.add(i);
        }
    }

    void quotient(uint32_t type, uint32_t result, uint32_t numerator, uint32_t denominator) {
        const uint32_t rough = marked(spv::Op::OpFDiv, type, numerator, denominator);
        correct(type, result, rough, residue(type, rough, denominator, numerator), denominator);
    }

    void root(uint32_t type, uint32_t result, uint32_t square) {
        const uint32_t rough = made();
        functions_.add(spv::Op::OpExtInst, {type, rough, built_in_, GLSLstd450Sqrt, square});
        const uint32_t twice = marked(spv::Op::OpFAdd, type, rough, rough);
        correct(type, result, rough, residue(type, rough, rough, square), twice);
    }

    /// a (1 - u) + b u, as GLM has it.
    void mix(uint32_t type, uint32_t result, uint32_t a, uint32_t b, uint32_t u) {
        const uint32_t rest = marked(spv::Op::OpFSub, type, one_of(type), u);
        const uint32_t first = marked(spv::Op::OpFMul, type, a, rest);
        const uint32_t second = marked(spv::Op::OpFMul, type, b, u);
        mark(result);
        functions_.add(spv::Op::OpFAdd, {type, result, first, second});
    }

    /// whole - a b, rounded once.
    uint32_t residue(uint32_t type, uint32_t a, uint32_t b, uint32_t whole) {
        const uint32_t minus = made(), difference = made();
        functions_.add(spv::Op::OpFNegate, {type, minus, a});
        functions_.add(spv::Op::OpExtInst, {type, difference, built_in_, GLSLstd450Fma, minus, b, whole});
        return difference;
    }

    /// result = rough + residue / divisor; rough itself where there is no residue (0, infinities).
    void correct(uint32_t type, uint32_t result, uint32_t rough, uint32_t residue, uint32_t divisor) {
        const uint32_t step = marked(spv::Op::OpFDiv, type, residue, divisor), is_nan = made(), kept = made();
        functions_.add(spv::Op::OpIsNan, {bool_of(floats_[type]), is_nan, step});
        functions_.add(spv::Op::OpSelect, {type, kept, is_nan, zero_of(type), step});
        mark(result);
        functions_.add(spv::Op::OpFAdd, {type, result, rough, kept});
    }

    uint32_t marked(spv::Op op, uint32_t type, uint32_t a, uint32_t b) {
        const uint32_t result = made();
        mark(result);
        functions_.add(op, {type, result, a, b});
        return result;
    }

    void mark(uint32_t id) {
        if (!marked_.insert(id).second) return;
        marks_.add(spv::Op::OpDecorate, {id, static_cast<uint32_t>(spv::Decoration::NoContraction)});
    }

    uint32_t made() { return bound_++; }

    uint32_t bool_of(uint32_t components) {
        uint32_t& id = bools_[components];
        if (id != 0) return id;
        const uint32_t scalar = components == 1 ? 0 : bool_of(1);
        id = made();
        if (components == 1)
            declarations_.add(spv::Op::OpTypeBool, {id});
        else
            declarations_.add(spv::Op::OpTypeVector, {id, scalar, components});
        return id;
    }

    uint32_t zero_of(uint32_t type) {
        uint32_t& id = zeros_[type];
        if (id != 0) return id;
        id = made();
        declarations_.add(spv::Op::OpConstantNull, {type, id});
        return id;
    }

    uint32_t one_of(uint32_t type) {
        uint32_t& id = ones_[type];
        if (id != 0) return id;
        const uint32_t scalar = floats_[type] == 1 ? 0 : one_of(scalar_);
        id = made();
        if (floats_[type] == 1) {
            declarations_.add(spv::Op::OpConstant, {type, id, std::bit_cast<uint32_t>(1.0f)});
            return id;
        }
        std::vector<uint32_t> operands{type, id};
        operands.insert(operands.end(), floats_[type], scalar);
        declarations_.add(spv::Op::OpConstantComposite, operands);
        return id;
    }

    bool mends_, in_head_ = true, in_functions_ = false;
    uint32_t bound_, built_in_ = 0, scalar_ = 0;  // scalar: the type of 32 bits
    std::map<uint32_t, uint32_t> floats_;         // types: how many components
    std::map<uint32_t, uint32_t> bools_;          // types by how many components
    std::map<uint32_t, uint32_t> zeros_;          // by type
    std::map<uint32_t, uint32_t> ones_;           // by type
    std::set<uint32_t> marked_;
    Section head_, marks_, declarations_, functions_;
};

}  // namespace

std::vector<uint32_t> rounded_alike(std::span<const uint32_t> module, bool mends_quotients) {
    assert(module.size() > header_words && module[0] == spv::MagicNumber);
    return Rounding(module, mends_quotients).module(module.first(header_words));
}

}  // namespace strandlab

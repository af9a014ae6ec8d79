//! Decodes 32-bit Thumb instructions.

use crate::{
    instruction::{Instruction, Kind, Registers},
    thumb::bit,
    thumb_float,
};

const PROGRAM_COUNTER: u16 = 15;

const fn of(kind: Kind) -> Instruction {
    Instruction::new(kind, 4)
}

/// A register, unless the field stands for none.
const fn unless_pc(register: u16) -> Registers {
    bit(register) & !bit(PROGRAM_COUNTER)
}

/// Decodes the instruction of two halfwords.
pub(crate) const fn decode(a: u16, b: u16) -> Instruction {
    if let Some(float) = thumb_float::decode(a, b) {
        return float;
    }
    match a >> 9 {
        0b1110100 => multiple(a, b),
        0b1110101 => shifted_register(a, b),
        0b1111000..=0b1111011 if b >> 15 == 0 => immediate(a, b),
        0b1111000..=0b1111011 => branch(a, b),
        0b1111100 => single(a, b),
        0b1111101 => registers(a, b),
        // Other coprocessors.
        _ => of(Kind::System),
    }
}

/// LDM, STM, LDRD, STRD, table branches.
const fn multiple(a: u16, b: u16) -> Instruction {
    let (address, is_load) = (bit(a), a >> 4 & 1 == 1);
    if a >> 6 & 1 == 0 {
        let words = b.count_ones() as u8;
        let is_return = is_load && b >> 15 == 1;
        let kind =
            if is_return { Kind::Return { words } } else { Kind::Multiple { words, is_load } };
        return of(kind).at(address);
    }
    if a & 0xFFF0 == 0xE8D0 && b & 0xFFE0 == 0xF000 {
        return of(Kind::Table).at(address | bit(b));
    }
    of(Kind::Multiple { words: 2, is_load }).at(address)
}

/// Data processing whose second operand is a register, shifted by a constant.
const fn shifted_register(a: u16, b: u16) -> Instruction {
    // A shift alone, MOV with one, is not late.
    let is_late = b & 0x70C0 != 0 && a & 15 != PROGRAM_COUNTER;
    of(Kind::Plain).reading(unless_pc(a) | unless_pc(b)).writing(unless_pc(b >> 8)).late(is_late)
}

/// Data processing with a constant.
const fn immediate(a: u16, b: u16) -> Instruction {
    let to = b >> 8;
    let reads = match a >> 4 & 0x3F {
        // MOVW.
        0b100100 => 0,
        // MOVT keeps a half of its result, BFI a part.
        0b101100 => bit(to),
        0b110110 => bit(to) | unless_pc(a),
        _ => unless_pc(a),
    };
    of(Kind::Plain).reading(reads).writing(unless_pc(to))
}

const fn branch(a: u16, b: u16) -> Instruction {
    of(match (b >> 14 & 1, b >> 12 & 1) {
        (1, _) => Kind::Call,
        (0, 1) => Kind::Branch { is_conditional: false },
        _ if a >> 7 & 7 == 7 => Kind::System,
        _ => Kind::Branch { is_conditional: true },
    })
}

/// A load or store of one register.
const fn single(a: u16, b: u16) -> Instruction {
    let is_indexed = a >> 7 & 1 == 0 && a & 15 != PROGRAM_COUNTER && b >> 11 & 1 == 0;
    let address = bit(a) | if is_indexed { bit(b) } else { 0 };
    let (to, is_word) = (b >> 12, a >> 5 & 3 == 2);
    if a >> 4 & 1 == 0 {
        of(Kind::Store { is_indexed }).at(address)
    } else if to == PROGRAM_COUNTER && is_word {
        of(Kind::Table).at(address)
    } else {
        of(Kind::Load).at(address).writing(unless_pc(to))
    }
}

/// Data processing of registers, products, divisions.
const fn registers(a: u16, b: u16) -> Instruction {
    let operands = unless_pc(a) | unless_pc(b);
    let to = unless_pc(b >> 8);
    match a >> 7 & 3 {
        2 => of(Kind::Multiply).reading(operands).writing(to).late(true),
        3 if b >> 4 & 15 == 15 && matches!(a >> 4 & 7, 1 | 3) => {
            of(Kind::Divide).reading(operands).writing(to)
        }
        3 => {
            let to = to | unless_pc(b >> 12);
            of(Kind::LongMultiply).reading(operands).writing(to).late(true)
        }
        _ => of(Kind::Plain).reading(operands).writing(to),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::instruction::Float;

    #[test]
    fn wide_instructions_are_decoded() {
        let plain = of(Kind::Plain);
        let cases = [
            // ldmia.w r4!, {r0-r3, r8}
            (0xe8b4, 0x010f, of(Kind::Multiple { words: 5, is_load: true }).at(0x10)),
            // pop.w {r4-r8, pc}
            (0xe8bd, 0x81f0, of(Kind::Return { words: 6 }).at(0x2000)),
            // push.w {r4-r8, lr}
            (0xe92d, 0x41f0, of(Kind::Multiple { words: 6, is_load: false }).at(0x2000)),
            // strd r2, r3, [r5]
            (0xe9c5, 0x2300, of(Kind::Multiple { words: 2, is_load: false }).at(0x20)),
            // ldrd r2, r3, [r5, #8]
            (0xe9d5, 0x2302, of(Kind::Multiple { words: 2, is_load: true }).at(0x20)),
            // tbb [pc, r1]
            (0xe8df, 0xf001, of(Kind::Table).at(0x8002)),
            // add.w r1, r2, r3
            (0xeb02, 0x0103, plain.reading(0b1100).writing(0b10)),
            // add.w r1, r2, r3, asr #16
            (0xeb02, 0x4123, plain.reading(0b1100).writing(0b10).late(true)),
            // sub.w r1, r2, r3, lsl #1
            (0xeba2, 0x0143, plain.reading(0b1100).writing(0b10).late(true)),
            // asr.w r1, r9, #16
            (0xea4f, 0x4129, plain.reading(0x200).writing(0b10)),
            // cmp.w r1, r9, which writes no register
            (0xebb1, 0x0f09, plain.reading(0x202)),
            // movw r1, #0x5555
            (0xf245, 0x5155, plain.writing(0b10)),
            // movt r1, #0x5555
            (0xf2c5, 0x5155, plain.reading(0b10).writing(0b10)),
            // mov.w r1, #0xff0000
            (0xf44f, 0x017f, plain.writing(0b10)),
            // addw r1, r2, #0x555
            (0xf202, 0x5155, plain.reading(0b100).writing(0b10)),
            // bfi r1, r2, #3, #4
            (0xf362, 0x01c6, plain.reading(0b110).writing(0b10)),
            // ubfx r1, r2, #3, #4
            (0xf3c2, 0x01c3, plain.reading(0b100).writing(0b10)),
            // bl
            (0xf000, 0xf802, of(Kind::Call)),
            // b.w
            (0xf000, 0xb802, of(Kind::Branch { is_conditional: false })),
            // bne.w
            (0xf040, 0x8002, of(Kind::Branch { is_conditional: true })),
            // mrs r0, primask
            (0xf3ef, 0x8010, of(Kind::System)),
            // dmb
            (0xf3bf, 0x8f5f, of(Kind::System)),
            // ldr.w r8, [r9, #4]
            (0xf8d9, 0x8004, of(Kind::Load).at(0x200).writing(0x100)),
            // ldr r8, [r9], #4
            (0xf859, 0x8b04, of(Kind::Load).at(0x200).writing(0x100)),
            // ldr.w r8, [r9, r1, lsl #2]
            (0xf859, 0x8021, of(Kind::Load).at(0x202).writing(0x100)),
            // str.w r8, [r9, r1]
            (0xf849, 0x8001, of(Kind::Store { is_indexed: true }).at(0x202)),
            // strh.w r8, [r9, #4]
            (0xf8a9, 0x8004, of(Kind::Store { is_indexed: false }).at(0x200)),
            // ldr.w pc, [r9]
            (0xf8d9, 0xf000, of(Kind::Table).at(0x200)),
            // mul r1, r2, r3
            (0xfb02, 0xf103, of(Kind::Multiply).reading(0b1100).writing(0b10).late(true)),
            // smmla r1, r2, r3, r4
            (0xfb52, 0x4103, of(Kind::Multiply).reading(0b1100).writing(0b10).late(true)),
            // umull r2, r3, r1, r0
            (0xfba1, 0x2300, of(Kind::LongMultiply).reading(0b11).writing(0b1100).late(true)),
            // udiv r1, r2, r0
            (0xfbb2, 0xf1f0, of(Kind::Divide).reading(0b101).writing(0b10)),
            // sdiv r1, r2, r0
            (0xfb92, 0xf1f0, of(Kind::Divide).reading(0b101).writing(0b10)),
            // clz r1, r2
            (0xfab2, 0xf182, plain.reading(0b100).writing(0b10)),
            // uxtb.w r8, r2
            (0xfa5f, 0xf882, plain.reading(0b100).writing(0x100)),
            // vmov s0, r1
            (0xee00, 0x1a10, of(Kind::Float(Float::Move)).reading(0b10).writing(1 << 32)),
        ];
        for (a, b, expected) in cases {
            assert_eq!(decode(a, b), expected, "{a:#06x} {b:#06x}");
        }
    }
}

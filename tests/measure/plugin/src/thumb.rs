//! Decodes 16-bit Thumb instructions, and tells them from the 32-bit ones.

use crate::{
    instruction::{Instruction, Kind, Registers},
    thumb_wide,
};

const STACK_POINTER: u16 = 13;
const PROGRAM_COUNTER: u16 = 15;

/// Decodes the instruction that begins with these bytes.
#[must_use]
pub const fn decode([a, b, c, d]: [u8; 4]) -> Instruction {
    let first = u16::from_le_bytes([a, b]);
    if first >> 11 >= 0b11101 {
        thumb_wide::decode(first, u16::from_le_bytes([c, d]))
    } else {
        narrow(first)
    }
}

pub(crate) const fn bit(register: u16) -> Registers {
    1 << (register & 15)
}

const fn of(kind: Kind) -> Instruction {
    Instruction::new(kind, 2)
}

const fn store(is_indexed: bool, address: Registers) -> Instruction {
    of(Kind::Store { is_indexed }).at(address)
}

const fn load(to: Registers, address: Registers) -> Instruction {
    of(Kind::Load).at(address).writing(to)
}

/// The low register whose number is at a bit.
const fn low(op: u16, at: u16) -> Registers {
    bit(op >> at & 7)
}

const fn narrow(op: u16) -> Instruction {
    let plain = of(Kind::Plain);
    let is_load = op >> 11 & 1 == 1;
    match op >> 11 {
        // Shifts by a constant.
        0..=2 => plain.reading(low(op, 3)).writing(low(op, 0)).setting_flags(),
        // Sums and differences of two registers, or of one and a constant.
        3 => {
            let second = if op >> 10 & 1 == 0 { low(op, 6) } else { 0 };
            plain.reading(low(op, 3) | second).writing(low(op, 0)).setting_flags()
        }
        // MOV, CMP, ADD and SUB with a constant.
        4 => plain.writing(low(op, 8)).setting_flags(),
        5 => plain.reading(low(op, 8)).setting_flags(),
        6 | 7 => plain.reading(low(op, 8)).writing(low(op, 8)).setting_flags(),
        8 if op >> 10 & 1 == 0 => data_processing(op),
        8 => any_register(op),
        9 => load(low(op, 8), bit(PROGRAM_COUNTER)),
        10 | 11 => {
            let address = low(op, 3) | low(op, 6);
            if op >> 9 & 7 <= 2 { store(true, address) } else { load(low(op, 0), address) }
        }
        12..=17 if is_load => load(low(op, 0), low(op, 3)),
        12..=17 => store(false, low(op, 3)),
        18 => store(false, bit(STACK_POINTER)),
        19 => load(low(op, 8), bit(STACK_POINTER)),
        20 => plain.writing(low(op, 8)),
        21 => plain.reading(bit(STACK_POINTER)).writing(low(op, 8)),
        22 | 23 => miscellaneous(op),
        24 | 25 => {
            let words = (op & 0xFF).count_ones() as u8;
            of(Kind::Multiple { words, is_load }).at(low(op, 8))
        }
        26 | 27 if op >> 8 & 15 >= 14 => of(Kind::System),
        26 | 27 => of(Kind::Branch { is_conditional: true }),
        _ => of(Kind::Branch { is_conditional: false }),
    }
}

/// AND to MVN of two low registers.
const fn data_processing(op: u16) -> Instruction {
    let (first, second) = (low(op, 0), low(op, 3));
    let code = op >> 6 & 15;
    let kind = if code == 13 { Kind::Multiply } else { Kind::Plain };
    let to = of(kind).setting_flags().reading(second);
    match code {
        // TST, CMP, CMN.
        8 | 10 | 11 => to.reading(first),
        // RSB, MVN.
        9 | 15 => to.writing(first),
        _ => to.reading(first).writing(first),
    }
}

/// ADD, CMP, MOV, BX and BLX of any two registers.
const fn any_register(op: u16) -> Instruction {
    let (to, from) = (op >> 4 & 8 | op & 7, bit(op >> 3 & 15));
    let plain = of(Kind::Plain).reading(from);
    match op >> 8 & 3 {
        1 => plain.reading(bit(to)).setting_flags(),
        0 if to != PROGRAM_COUNTER => plain.reading(bit(to)).writing(bit(to)),
        2 if to != PROGRAM_COUNTER => plain.writing(bit(to)),
        _ => of(Kind::Register).reading(from),
    }
}

/// The instructions that begin with 1011.
const fn miscellaneous(op: u16) -> Instruction {
    let stack = bit(STACK_POINTER);
    match op >> 8 & 15 {
        // ADD and SUB of the stack pointer.
        0 => of(Kind::Plain).reading(stack).writing(stack),
        // CBZ, CBNZ.
        1 | 3 | 9 | 11 => of(Kind::Branch { is_conditional: true }).reading(low(op, 0)),
        // Extensions, byte order.
        2 | 10 => of(Kind::Plain).reading(low(op, 3)).writing(low(op, 0)),
        4 | 5 => {
            let words = (op & 0x1FF).count_ones() as u8;
            of(Kind::Multiple { words, is_load: false }).at(stack)
        }
        12 => {
            let words = (op & 0xFF).count_ones() as u8;
            of(Kind::Multiple { words, is_load: true }).at(stack)
        }
        13 => of(Kind::Return { words: (op & 0x1FF).count_ones() as u8 }).at(stack),
        15 if op & 15 != 0 => of(Kind::It),
        // NOP and other hints.
        15 => of(Kind::Plain),
        _ => of(Kind::System),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn narrow_instructions_are_decoded() {
        let decode = |op: u16| {
            let [a, b] = op.to_le_bytes();
            decode([a, b, 0, 0])
        };
        let plain = of(Kind::Plain);
        let cases = [
            (0x2064, plain.writing(1).setting_flags()), // movs r0, #100
            (0x3801, plain.reading(1).writing(1).setting_flags()), // subs r0, #1
            (0x2b07, plain.reading(8).setting_flags()), // cmp r3, #7
            (0x1889, plain.reading(0b110).writing(0b10).setting_flags()), // adds r1, r1, r2
            (0x1ddf, plain.reading(0x08).writing(0x80).setting_flags()), // adds r7, r3, #7
            (0x0089, plain.reading(2).writing(2).setting_flags()), // lsls r1, r1, #2
            (0x4291, plain.reading(0b110).setting_flags()), // cmp r1, r2
            (0x43d1, plain.reading(0b100).writing(0b10).setting_flags()), // mvns r1, r2
            (0x4448, plain.reading(0x201).writing(1)),  // add r0, r9
            (0x4680, plain.reading(1).writing(0x100)),  // mov r8, r0
            (0xb2d1, plain.reading(0b100).writing(0b10)), // uxtb r1, r2
            (0xb082, plain.reading(0x2000).writing(0x2000)), // sub sp, #8
            (0xa802, plain.reading(0x2000).writing(1)), // add r0, sp, #8
            (0xbf00, plain),                            // nop
            (0x4348, of(Kind::Multiply).reading(3).writing(1).setting_flags()), // muls r0, r1
            (0x4b03, load(8, 0x8000)),                  // ldr r3, [pc, #12]
            (0x58a1, load(2, 0b1_0100)),                // ldr r1, [r4, r2]
            (0x50a1, store(true, 0b1_0100)),            // str r1, [r4, r2]
            (0x8921, load(2, 0x10)),                    // ldrh r1, [r4, #8]
            (0x7021, store(false, 0x10)),               // strb r1, [r4]
            (0x9102, store(false, 0x2000)),             // str r1, [sp, #8]
            (0x9902, load(2, 0x2000)),                  // ldr r1, [sp, #8]
            (0xcc0f, of(Kind::Multiple { words: 4, is_load: true }).at(0x10)), // ldm r4!, ..
            (0xc50f, of(Kind::Multiple { words: 4, is_load: false }).at(0x20)), // stm r5!, ..
            (0xb510, of(Kind::Multiple { words: 2, is_load: false }).at(0x2000)), // push r4, lr
            (0xbd10, of(Kind::Return { words: 2 }).at(0x2000)), // pop r4, pc
            (0xbc30, of(Kind::Multiple { words: 2, is_load: true }).at(0x2000)), // pop r4, r5
            (0xd1fd, of(Kind::Branch { is_conditional: true })), // bne
            (0xb13a, of(Kind::Branch { is_conditional: true }).reading(0b100)), // cbz r2
            (0xe7fe, of(Kind::Branch { is_conditional: false })), // b
            (0x4770, of(Kind::Register).reading(0x4000)), // bx lr
            (0x46a7, of(Kind::Register).reading(0x10)), // mov pc, r4
            (0xbf08, of(Kind::It)),                     // it eq
            (0xbeab, of(Kind::System)),                 // bkpt #0xab
            (0xdf00, of(Kind::System)),                 // svc #0
        ];
        for (op, expected) in cases {
            assert_eq!(decode(op), expected, "{op:#06x}");
        }
    }
}

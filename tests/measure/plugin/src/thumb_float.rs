//! Decodes the instructions of the FPU. Registers of 64 bits are not told apart: the FPU of a
//! Cortex-M4 computes with 32.

use crate::{
    instruction::{Float, Instruction, Kind, Registers},
    thumb::bit,
};

const fn of(float: Float) -> Instruction {
    Instruction::new(Kind::Float(float), 4)
}

/// The register S0 to S31 whose upper four bits begin at bit `at`, and whose lowest bit is at
/// `lowest`.
const fn single(upper: u16, at: u16, lowest: u16, lowest_at: u16) -> Registers {
    let number = (upper >> at & 15) << 1 | lowest >> lowest_at & 1;
    1 << (32 + number)
}

const fn destination(a: u16, b: u16) -> Registers {
    single(b, 12, a, 6)
}

const fn first(a: u16, b: u16) -> Registers {
    single(a, 0, b, 7)
}

const fn second(b: u16) -> Registers {
    single(b, 0, b, 5)
}

/// Decodes the instruction of two halfwords, if it is one of the FPU.
pub(crate) const fn decode(a: u16, b: u16) -> Option<Instruction> {
    if b >> 9 & 7 != 0b101 {
        return None;
    }
    Some(match a >> 8 {
        0xEC | 0xED => memory(a, b),
        0xEE if b >> 4 & 1 == 1 => transfer(a, b),
        0xEE => arithmetic(a, b),
        // Of later FPUs: the larger of two, rounding.
        0xFE => of(Float::Arithmetic).reading(first(a, b) | second(b)).writing(destination(a, b)),
        _ => return None,
    })
}

/// VLDR, VSTR, VLDM, VSTM, VPUSH, VPOP, and VMOV of two registers.
const fn memory(a: u16, b: u16) -> Instruction {
    let is_load = a >> 4 & 1 == 1;
    let is_double = b >> 8 & 1 == 1;
    // Bits 8, 7 and 5: whether the address is offset, to where, and whether it is written back.
    let words = match a & 0x01A0 {
        // VMOV: 2 cycles, as one word in memory takes.
        0 => return Instruction::new(Kind::Multiple { words: 1, is_load }, 4),
        0x0100 | 0x0180 if is_double => 2,
        0x0100 | 0x0180 if is_load => {
            return of(Float::Load).at(bit(a)).writing(destination(a, b));
        }
        0x0100 | 0x0180 => return of(Float::Store).at(bit(a)).reading(destination(a, b)),
        _ => (b & 0xFF) as u8,
    };
    Instruction::new(Kind::Multiple { words, is_load }, 4).at(bit(a))
}

/// VMOV between a register of the core and one of the FPU; VMRS, VMSR.
const fn transfer(a: u16, b: u16) -> Instruction {
    let (of_core, of_fpu) = (bit(b >> 12), first(a, b));
    let is_special = a >> 5 & 7 == 0b111;
    match a >> 4 & 1 {
        // To the flags, which no register stands for.
        1 if is_special && b >> 12 == 15 => of(Float::Move),
        1 if is_special => of(Float::Move).writing(of_core),
        1 => of(Float::Move).reading(of_fpu).writing(of_core),
        _ if is_special => of(Float::Move).reading(of_core),
        _ => of(Float::Move).reading(of_core).writing(of_fpu),
    }
}

/// What computes in registers of the FPU.
const fn arithmetic(a: u16, b: u16) -> Instruction {
    let (to, operands) = (destination(a, b), first(a, b) | second(b));
    // Bits 7, 5 and 4: bit 6 belongs to the register.
    match (a >> 7 & 1, a >> 4 & 3) {
        // VMLA, VMLS, VNMLA, VNMLS; VFNMA, VFNMS, VFMA, VFMS.
        (0, 0 | 1) | (1, 1 | 2) => of(Float::MultiplyAdd).reading(operands | to).writing(to),
        // VMUL, VNMUL; VADD, VSUB.
        (0, _) => of(Float::Arithmetic).reading(operands).writing(to),
        (_, 0) => of(Float::Divide).reading(operands).writing(to),
        _ => of_one(a, b),
    }
}

/// What has one operand.
const fn of_one(a: u16, b: u16) -> Instruction {
    let (to, operand) = (destination(a, b), second(b));
    match (a & 15, b >> 6 & 3) {
        // VMOV of a constant.
        (_, 0 | 2) => of(Float::Move).writing(to),
        (1, 3) => of(Float::Divide).reading(operand).writing(to),
        // VMOV, VABS, VNEG.
        (0, _) | (1, _) => of(Float::Move).reading(operand).writing(to),
        // VCMP, of two and with 0: to the flags.
        (4, _) => of(Float::Move).reading(operand | to),
        (5, _) => of(Float::Move).reading(to),
        // VCVT.
        _ => of(Float::Arithmetic).reading(operand).writing(to),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn s(register: u32) -> Registers {
        1 << (32 + register)
    }

    #[test]
    fn instructions_of_the_fpu_are_decoded() {
        let (plain, moved) = (of(Float::Arithmetic), of(Float::Move));
        let multiple = |words, is_load| Instruction::new(Kind::Multiple { words, is_load }, 4);
        let cases = [
            // vmov s0, r1
            (0xee00, 0x1a10, moved.reading(0b10).writing(s(0))),
            // vmov r3, s24
            (0xee1c, 0x3a10, moved.reading(s(24)).writing(0b1000)),
            // vmov.f32 s19, s4
            (0xeef0, 0x9a42, moved.reading(s(4)).writing(s(19))),
            // vmov.f32 s5, #1.0
            (0xeef7, 0x2a00, moved.writing(s(5))),
            // vabs.f32 s1, s2
            (0xeef0, 0x0ac1, moved.reading(s(2)).writing(s(1))),
            // vneg.f32 s1, s2
            (0xeef1, 0x0a41, moved.reading(s(2)).writing(s(1))),
            // vcmp.f32 s17, s0
            (0xeef4, 0x8a40, moved.reading(s(17) | s(0))),
            // vcmp.f32 s17, #0
            (0xeef5, 0x8a40, moved.reading(s(17))),
            // vmrs apsr_nzcv, fpscr
            (0xeef1, 0xfa10, moved),
            // vmrs r2, fpscr
            (0xeef1, 0x2a10, moved.writing(0b100)),
            // vmsr fpscr, r2
            (0xeee1, 0x2a10, moved.reading(0b100)),
            // vadd.f32 s17, s20, s3
            (0xee7a, 0x8a21, plain.reading(s(20) | s(3)).writing(s(17))),
            // vsub.f32 s1, s2, s3
            (0xee71, 0x0a61, plain.reading(s(2) | s(3)).writing(s(1))),
            // vmul.f32 s1, s2, s31
            (0xee61, 0x0a2f, plain.reading(s(2) | s(31)).writing(s(1))),
            // vcvt.s32.f32 s24, s25
            (0xeebd, 0xcaec, plain.reading(s(25)).writing(s(24))),
            // vcvt.f32.u32 s0, s1
            (0xeeb8, 0x0a60, plain.reading(s(1)).writing(s(0))),
            // vmla.f32 s24, s30, s8
            (0xee0f, 0xca04, of(Float::MultiplyAdd).reading(s(24) | s(30) | s(8)).writing(s(24))),
            // vnmls.f32 s1, s2, s3
            (0xee51, 0x0a21, of(Float::MultiplyAdd).reading(s(1) | s(2) | s(3)).writing(s(1))),
            // vfma.f32 s1, s2, s3
            (0xeee1, 0x0a21, of(Float::MultiplyAdd).reading(s(1) | s(2) | s(3)).writing(s(1))),
            // vfnms.f32 s1, s2, s3
            (0xeed1, 0x0a21, of(Float::MultiplyAdd).reading(s(1) | s(2) | s(3)).writing(s(1))),
            // vdiv.f32 s1, s2, s3
            (0xeec1, 0x0a21, of(Float::Divide).reading(s(2) | s(3)).writing(s(1))),
            // vsqrt.f32 s1, s2
            (0xeef1, 0x0ac1, of(Float::Divide).reading(s(2)).writing(s(1))),
            // vldr s0, [r4, #4]
            (0xed94, 0x0a01, of(Float::Load).at(0x10).writing(s(0))),
            // vldr s3, [r4, #-4]
            (0xed54, 0x1a01, of(Float::Load).at(0x10).writing(s(3))),
            // vstr s17, [sp, #8]
            (0xedcd, 0x8a02, of(Float::Store).at(0x2000).reading(s(17))),
            // vldr d1, [r4]
            (0xed94, 0x1b00, multiple(2, true).at(0x10)),
            // vpush {d8, d9}
            (0xed2d, 0x8b04, multiple(4, false).at(0x2000)),
            // vpop {s16, s17, s18}
            (0xecbd, 0x8a03, multiple(3, true).at(0x2000)),
            // vstmia r3!, {s1, s2}
            (0xece3, 0x0a02, multiple(2, false).at(8)),
            // vmov r0, r1, d2
            (0xec51, 0x0b12, multiple(1, true)),
            // vmov d2, r0, r1
            (0xec41, 0x0b12, multiple(1, false)),
            // vmov s2, s3, r0, r1
            (0xec41, 0x0a11, multiple(1, false)),
        ];
        for (a, b, expected) in cases {
            assert_eq!(decode(a, b), Some(expected), "{a:#06x} {b:#06x}");
        }
        // movw r0, #1; umull r2, r3, r1, r0; strd r2, r3, [r5]
        for (a, b) in [(0xf240, 0x0001), (0xfba1, 0x2300), (0xe9c5, 0x2300)] {
            assert_eq!(decode(a, b), None, "{a:#06x} {b:#06x}");
        }
    }
}

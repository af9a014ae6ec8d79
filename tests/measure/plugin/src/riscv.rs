//! Decodes RV32IMC.

use crate::instruction::{Instruction, Kind, Registers};

/// Decodes the instruction that begins with these bytes.
#[must_use]
pub const fn decode(bytes: [u8; 4]) -> Instruction {
    let op = u32::from_le_bytes(bytes);
    if op & 3 == 3 { wide(op) } else { narrow(op & 0xFFFF) }
}

/// A register; none for `x0`, which is always 0.
const fn bit(register: u32) -> Registers {
    (1 << (register & 31)) & !1
}

const fn wide(op: u32) -> Instruction {
    let (to, first, second) = (bit(op >> 7), bit(op >> 15), bit(op >> 20));
    let of = Instruction::new;
    match op >> 2 & 31 {
        0 => of(Kind::Load, 4).at(first).writing(to),
        8 => of(Kind::Store { is_indexed: false }, 4).at(first).reading(second),
        24 => of(Kind::Branch { is_conditional: true }, 4).reading(first | second),
        25 => of(Kind::Register, 4).reading(first).writing(to),
        27 => of(Kind::Call, 4).writing(to),
        12 if op >> 25 == 1 => {
            let kind = match op >> 12 & 7 {
                0 => Kind::Multiply,
                1..=3 => Kind::LongMultiply,
                _ => Kind::Divide,
            };
            of(kind, 4).reading(first | second).writing(to)
        }
        12 => of(Kind::Plain, 4).reading(first | second).writing(to),
        4 => of(Kind::Plain, 4).reading(first).writing(to),
        28 => of(Kind::System, 4).reading(first).writing(to),
        // LUI, AUIPC, FENCE.
        _ => of(Kind::Plain, 4).writing(to),
    }
}

const fn narrow(op: u32) -> Instruction {
    // Three bits name x8 to x15.
    let (first, second) = (bit(8 + (op >> 7 & 7)), bit(8 + (op >> 2 & 7)));
    let (any_first, any_second) = (bit(op >> 7), bit(op >> 2));
    let (ra, sp) = (bit(1), bit(2));
    const fn of(kind: Kind) -> Instruction {
        Instruction::new(kind, 2)
    }
    let plain = of(Kind::Plain);
    let store = of(Kind::Store { is_indexed: false });
    match (op & 3, op >> 13) {
        (0, 0) => plain.reading(sp).writing(second),
        (0, 2) => of(Kind::Load).at(first).writing(second),
        (0, _) => store.at(first).reading(second),
        // ADDI and NOP, SLLI.
        (1, 0) | (2, 0) => plain.reading(any_first).writing(any_first),
        (1, 1) => of(Kind::Call).writing(ra),
        // ADDI16SP is among LUI.
        (1, 3) if op >> 7 & 31 == 2 => plain.reading(sp).writing(sp),
        (1, 2 | 3) => plain.writing(any_first),
        (1, 4) if op >> 10 & 3 == 3 => plain.reading(first | second).writing(first),
        (1, 4) => plain.reading(first).writing(first),
        (1, 5) => of(Kind::Call),
        (1, _) => of(Kind::Branch { is_conditional: true }).reading(first),
        (2, 2) => of(Kind::Load).at(sp).writing(any_first),
        // JR, JALR, EBREAK; MV, ADD.
        (2, 4) if any_second == 0 && any_first == 0 => of(Kind::System),
        (2, 4) if any_second == 0 => {
            of(Kind::Register).reading(any_first).writing(if op >> 12 & 1 == 1 { ra } else { 0 })
        }
        (2, 4) => {
            let addend = if op >> 12 & 1 == 1 { any_first } else { 0 };
            plain.reading(any_second | addend).writing(any_first)
        }
        (2, 6) => store.at(sp).reading(any_second),
        _ => plain,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The set of registers with these numbers.
    fn x(numbers: &[u32]) -> Registers {
        numbers.iter().fold(0, |set, number| set | 1 << number)
    }

    #[test]
    fn instructions_are_decoded() {
        let of = Instruction::new;
        let plain = of(Kind::Plain, 4);
        let branch = Kind::Branch { is_conditional: true };
        let store = Kind::Store { is_indexed: false };
        let cases = [
            (0x00c5_a503, of(Kind::Load, 4).at(x(&[11])).writing(x(&[10]))), // lw a0, 12(a1)
            (0x00a5_a623, of(store, 4).at(x(&[11])).reading(x(&[10]))),      // sw a0, 12(a1)
            (0xfea5_9ee3, of(branch, 4).reading(x(&[10, 11]))),              // bne a1, a0
            (0x0000_00ef, of(Kind::Call, 4).writing(x(&[1]))),               // jal
            (0x0005_80e7, of(Kind::Register, 4).reading(x(&[11])).writing(x(&[1]))), // jalr a1
            (0x02b5_0533, of(Kind::Multiply, 4).reading(x(&[10, 11])).writing(x(&[10]))), // mul
            (0x02b5_1533, of(Kind::LongMultiply, 4).reading(x(&[10, 11])).writing(x(&[10]))), // mulh
            (0x02b5_5533, of(Kind::Divide, 4).reading(x(&[10, 11])).writing(x(&[10]))), // divu
            (0x00b5_0533, plain.reading(x(&[10, 11])).writing(x(&[10]))), // add a0, a0, a1
            (0x00c5_8513, plain.reading(x(&[11])).writing(x(&[10]))),     // addi a0, a1, 12
            (0x0000_1537, plain.writing(x(&[10]))),                       // lui a0, 1
            (0xb000_2573, of(Kind::System, 4).writing(x(&[10]))),         // csrr a0, mcycle
            (0x4588, of(Kind::Load, 2).at(x(&[11])).writing(x(&[10]))),   // c.lw a0, 8(a1)
            (0xc588, of(store, 2).at(x(&[11])).reading(x(&[10]))),        // c.sw a0, 8(a1)
            (0x4532, of(Kind::Load, 2).at(x(&[2])).writing(x(&[10]))),    // c.lwsp a0, 12(sp)
            (0xc62a, of(store, 2).at(x(&[2])).reading(x(&[10]))),         // c.swsp a0, 12(sp)
            (0x157d, of(Kind::Plain, 2).reading(x(&[10])).writing(x(&[10]))), // c.addi a0, -1
            (0x4501, of(Kind::Plain, 2).writing(x(&[10]))),               // c.li a0, 0
            (0x1141, of(Kind::Plain, 2).reading(x(&[2])).writing(x(&[2]))), // c.addi sp, -16
            (0x7139, of(Kind::Plain, 2).reading(x(&[2])).writing(x(&[2]))), // c.addi16sp -64
            (0x0068, of(Kind::Plain, 2).reading(x(&[2])).writing(x(&[10]))), // c.addi4spn a0, 12
            (0x8d0d, of(Kind::Plain, 2).reading(x(&[10, 11])).writing(x(&[10]))), // c.sub a0, a1
            (0x8509, of(Kind::Plain, 2).reading(x(&[10])).writing(x(&[10]))), // c.srai a0, 2
            (0x852e, of(Kind::Plain, 2).reading(x(&[11])).writing(x(&[10]))), // c.mv a0, a1
            (0x952e, of(Kind::Plain, 2).reading(x(&[10, 11])).writing(x(&[10]))), // c.add a0, a1
            (0xf57d, of(branch, 2).reading(x(&[10]))),                    // c.bnez a0
            (0xa001, of(Kind::Call, 2)),                                  // c.j
            (0x2001, of(Kind::Call, 2).writing(x(&[1]))),                 // c.jal
            (0x8082, of(Kind::Register, 2).reading(x(&[1]))),             // c.jr ra
            (0x9582, of(Kind::Register, 2).reading(x(&[11])).writing(x(&[1]))), // c.jalr a1
            (0x9002, of(Kind::System, 2)),                                // c.ebreak
        ];
        for (op, expected) in cases {
            assert_eq!(decode(u32::to_le_bytes(op)), expected, "{op:#010x}");
        }
    }
}

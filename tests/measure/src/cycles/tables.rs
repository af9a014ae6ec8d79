//! The timing tables of the cores, with the source of each row.
//!
//! "Recalled" marks what stands in no document that could be read; all else is from the text named.

use super::timing::{Model, Row, Timing};

const fn model(name: &'static str) -> Model {
    Model { name, is_in_flash: false }
}

const M0PLUS_TABLE: &str = "ARM DDI0484C, table 3.1";
const M0PLUS_PROGRAMS: &str =
    "rp2040js 1.4.1 and the executor symex, which both follow ARM DDI0484C, table 3.1";

pub(super) const M0PLUS: Timing = Timing {
    has_fpu: false,
    models: &[
        model("cycles"),
        model("multiply in 32"),
        Model { name: "RP2040, flash", is_in_flash: true },
    ],
    rows: &[
        Row {
            what: "loads and stores of one register: 2",
            count: |counts| counts.loads + counts.stores,
            more: &[1, 1, 1],
            source: M0PLUS_TABLE,
        },
        Row {
            what: "LDM, STM, PUSH, POP: 1, and 1 for each word",
            count: |counts| counts.multiple_words + counts.return_words,
            more: &[1, 1, 1],
            source: M0PLUS_PROGRAMS,
        },
        Row {
            what: "POP with the program counter: 3, and 1 for each word",
            count: |counts| counts.returns,
            more: &[2, 2, 2],
            source: "symex; rp2040js has 2 in place of 3, ARM's table of the M0 4",
        },
        Row {
            what: "branches taken: 2",
            count: |counts| counts.taken,
            more: &[1, 1, 1],
            source: M0PLUS_PROGRAMS,
        },
        Row {
            what: "BL: 3",
            count: |counts| counts.calls,
            more: &[2, 2, 2],
            source: M0PLUS_PROGRAMS,
        },
        Row {
            what: "BX, BLX, MOV and ADD to the program counter: 2",
            count: |counts| counts.register_jumps,
            more: &[1, 1, 1],
            source: M0PLUS_TABLE,
        },
        Row {
            what: "barriers, MRS, MSR: 3",
            count: |counts| counts.systems,
            more: &[2, 2, 2],
            source: M0PLUS_PROGRAMS,
        },
        Row {
            what: "MULS: 1 or 32, as the chip has it",
            count: |counts| counts.multiplies,
            more: &[0, 31, 0],
            source: "ARM DDI0484C, table 3.1; that the RP2040 has the fast one is recalled",
        },
    ],
};

const M4_TABLE: &str = "ARM DDI0439D, table 3-1";
const M4_PAIRS: &str = "ARM DDI0439D, 3.3.2; jnk0le measures the same on an STM32F407";

const M4_FPU: &str = "ARM DDI0439D, table 7-1, recalled";
const M4_FPU_QUOTED: &str =
    "ARM DDI0439D, table 7-1, as quoted at electronics.stackexchange 544886";

pub(super) const M4: Timing = Timing {
    has_fpu: true,
    models: &[model("cycles"), model("least"), model("most")],
    rows: &[
        Row {
            what: "loads: 2, or 1 behind a load that their address does not need",
            count: |counts| counts.loads - counts.pipelined_loads,
            more: &[1, 1, 1],
            source: M4_PAIRS,
        },
        Row {
            what: "stores: 1, or 2 to the sum of two registers, unless behind a load",
            count: |counts| counts.indexed_stores,
            more: &[1, 1, 1],
            source: M4_PAIRS,
        },
        Row {
            what: "an address from the arithmetic right before: 1 more",
            count: |counts| counts.address_stalls,
            more: &[1, 1, 1],
            source: M4_PAIRS,
        },
        Row {
            what: "LDM, STM, PUSH, POP, LDRD, STRD: 1, and 1 for each word",
            count: |counts| counts.multiple_words + counts.return_words,
            more: &[1, 1, 1],
            source: M4_TABLE,
        },
        Row {
            what: "branches taken, calls, jumps, POP with the program counter: 1 to 3 more",
            count: |counts| counts.taken + counts.calls + counts.register_jumps + counts.returns,
            more: &[2, 1, 3],
            source: M4_TABLE,
        },
        Row {
            what: "TBB, TBH, LDR to the program counter: 2 to 4 more",
            count: |counts| counts.table_jumps,
            more: &[3, 2, 4],
            source: M4_TABLE,
        },
        Row {
            what: "UDIV, SDIV: 2 to 12; most quotients here have at most 5 bits",
            count: |counts| counts.divides,
            more: &[2, 1, 11],
            source: M4_TABLE,
        },
        Row {
            what: "IT: 1, or 0 behind a 16-bit instruction",
            count: |counts| counts.its_folded,
            more: &[0, -1, 0],
            source: M4_TABLE,
        },
        Row {
            what: "VLDR, VSTR: 2, or 1 as LDR and STR between others",
            count: |counts| counts.float_loads + counts.float_stores,
            more: &[1, 0, 1],
            source: M4_FPU,
        },
        Row {
            what: "VMLA, VFMA: 3",
            count: |counts| counts.float_multiply_adds,
            more: &[2, 2, 2],
            source: M4_FPU_QUOTED,
        },
        Row {
            what: "VDIV, VSQRT: 14, or 1 if no other instruction of the FPU follows",
            count: |counts| counts.float_divides,
            more: &[13, 0, 13],
            source: M4_FPU,
        },
        Row {
            what: "a sum, product or conversion of the FPU that the next one needs: 1 more",
            count: |counts| counts.float_late_uses,
            more: &[1, 1, 1],
            source: M4_FPU_QUOTED,
        },
    ],
};

const M33_MEASURED: &str = "jnk0le, pipeline cycle test, measured on an RP2350";

pub(super) const M33: Timing = Timing {
    has_fpu: false,
    models: &[model("cycles"), model("least"), model("most")],
    rows: &[
        Row {
            what: "loads, if the next instruction starts with their value: 2",
            count: |counts| counts.load_uses,
            more: &[1, 1, 1],
            source: M33_MEASURED,
        },
        Row {
            what: "products and shifted operands, if the next instruction starts with them: 2",
            count: |counts| counts.late_uses,
            more: &[1, 0, 1],
            source: M33_MEASURED,
        },
        Row {
            what: "LDM, STM, PUSH, POP, LDRD, STRD: 1 for each word",
            count: |counts| {
                counts.multiple_words + counts.return_words - counts.multiples - counts.returns
            },
            more: &[1, 1, 1],
            source: M33_MEASURED,
        },
        Row {
            what: "branches taken: 2",
            count: |counts| counts.taken,
            more: &[1, 1, 1],
            source: M33_MEASURED,
        },
        Row {
            what: "16-bit ones behind a 16-bit instruction that sets no flags: 1",
            count: |counts| counts.taken_folded,
            more: &[-1, -1, -1],
            source: M33_MEASURED,
        },
        Row {
            what: "16-bit branches not taken behind a 16-bit instruction: 0",
            count: |counts| counts.untaken_folded,
            more: &[-1, -1, -1],
            source: M33_MEASURED,
        },
        Row {
            what: "IT behind a 16-bit instruction: 0",
            count: |counts| counts.its_folded,
            more: &[-1, -1, -1],
            source: M33_MEASURED,
        },
        Row {
            what: "calls and jumps to a register: 2 or 3",
            count: |counts| counts.calls + counts.register_jumps,
            more: &[1, 1, 2],
            source: "as a branch taken; not measured by anyone",
        },
        Row {
            what: "POP with the program counter: 1 to 3 more",
            count: |counts| counts.returns,
            more: &[1, 1, 3],
            source: "as a branch taken; not measured by anyone",
        },
        Row {
            what: "TBB, TBH, LDR to the program counter: 2 to 4 more",
            count: |counts| counts.table_jumps,
            more: &[3, 2, 4],
            source: "as on the M4; not measured by anyone",
        },
        Row {
            what: "MULS of 16 bits, which sets flags: 2",
            count: |counts| counts.narrow_multiplies,
            more: &[1, 1, 1],
            source: M33_MEASURED,
        },
        Row {
            what: "UDIV, SDIV: 2 to 11",
            count: |counts| counts.divides,
            more: &[3, 1, 10],
            source: "recalled",
        },
    ],
};

const HAZARD3_TABLE: &str = "Hazard3, \"Instruction Cycle Counts\" of its documentation";

pub(super) const HAZARD3: Timing = Timing {
    has_fpu: false,
    models: &[model("cycles")],
    rows: &[
        Row {
            what: "loads, if the next instruction needs their value: 2",
            count: |counts| counts.load_uses,
            more: &[1],
            source: HAZARD3_TABLE,
        },
        Row {
            what: "branches: 1 if predicted, else 2; the last one taken backwards is predicted",
            count: |counts| counts.mispredictions,
            more: &[1],
            source: HAZARD3_TABLE,
        },
        Row {
            what: "JAL, JALR: 2",
            count: |counts| counts.calls + counts.register_jumps,
            more: &[1],
            source: HAZARD3_TABLE,
        },
        Row {
            what: "jumps to a 32-bit instruction that does not begin at a word: 1 more",
            count: |counts| counts.split_targets,
            more: &[1],
            source: HAZARD3_TABLE,
        },
        Row {
            what: "DIV, REM: 18 or 19, taken as 18",
            count: |counts| counts.divides,
            more: &[17],
            source: HAZARD3_TABLE,
        },
    ],
};

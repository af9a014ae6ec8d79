//! What timing needs to know of an instruction: the same for Thumb and RISC-V.

/// A set of registers, one bit each: those of the core, and from bit 32 on S0 to S31 of the FPU.
pub type Registers = u64;

/// What an instruction is, for its timing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Data processing; anything that takes one cycle.
    Plain,
    /// A product of 32 bits, or the upper 32 bits of one.
    Multiply,
    /// A product of 64 bits; MULH.
    LongMultiply,
    /// A division or a remainder.
    Divide,
    /// Loads one register.
    Load,
    /// Stores one register.
    Store {
        /// Whether its address is the sum of two registers.
        is_indexed: bool,
    },
    /// LDM, STM, PUSH, POP, LDRD, STRD.
    Multiple {
        /// The words moved.
        words: u8,
        /// Whether it loads them.
        is_load: bool,
    },
    /// POP or LDM with the program counter.
    Return {
        /// The words loaded, the program counter among them.
        words: u8,
    },
    /// A branch to a fixed place.
    Branch {
        /// Whether it is taken depends on a condition.
        is_conditional: bool,
    },
    /// BL; JAL.
    Call,
    /// A jump to an address in a register.
    Register,
    /// A jump to an address from a table.
    Table,
    /// IT.
    It,
    /// An instruction of the FPU, but those that load or store several registers.
    Float(Float),
    /// Barriers, special registers, BKPT; CSR.
    System,
}

/// What an instruction of the FPU is, for its timing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Float {
    /// Moves, the sign, comparisons, the status register.
    Move,
    /// Sums, products and conversions.
    Arithmetic,
    /// A product that is added to or subtracted from a register.
    MultiplyAdd,
    /// Quotients and square roots.
    Divide,
    /// Loads one register.
    Load,
    /// Stores one register.
    Store,
}

/// A decoded instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// What it is.
    pub kind: Kind,
    /// Its length in bytes.
    pub size: u8,
    /// Registers that it needs at its start. What a Thumb store stores, and what a product is added
    /// to, is needed later, and not among them.
    pub reads: Registers,
    /// Registers that its address comes from, if it loads or stores. They are in `reads`, too.
    pub address: Registers,
    /// Registers that it computes or loads.
    pub writes: Registers,
    /// Whether it sets flags. Only known of 16-bit instructions outside an IT block.
    pub sets_flags: bool,
    /// Whether its result is ready a cycle later than others: of a shifted operand or a product.
    pub is_late: bool,
}

impl Instruction {
    /// An instruction that touches no register.
    #[must_use]
    pub const fn new(kind: Kind, size: u8) -> Self {
        Self { kind, size, reads: 0, address: 0, writes: 0, sets_flags: false, is_late: false }
    }

    /// The same, which needs these registers.
    #[must_use]
    pub const fn reading(self, registers: Registers) -> Self {
        Self { reads: self.reads | registers, ..self }
    }

    /// The same, which finds its address by these registers.
    #[must_use]
    pub const fn at(self, registers: Registers) -> Self {
        Self { address: registers, ..self.reading(registers) }
    }

    /// The same, which computes these registers.
    #[must_use]
    pub const fn writing(self, registers: Registers) -> Self {
        Self { writes: self.writes | registers, ..self }
    }

    /// The same, which also sets flags.
    #[must_use]
    pub const fn setting_flags(self) -> Self {
        Self { sets_flags: true, ..self }
    }

    /// The same, whose result is late if `is_late`.
    #[must_use]
    pub const fn late(self, is_late: bool) -> Self {
        Self { is_late, ..self }
    }
}

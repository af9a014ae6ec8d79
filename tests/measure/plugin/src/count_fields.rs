//! What is counted. The package `measure`, which reads the counts, includes this file, so that each
//! count is declared once.

/// Hands the counts to the macro `$declare`.
macro_rules! count_fields {
    ($declare:ident) => {
        $declare! {
            /// All instructions.
            instructions,
            /// Loads of one register.
            loads,
            /// Loads right behind a load that their address does not need.
            pipelined_loads,
            /// Instructions right behind a load whose value they need at their start.
            load_uses,
            /// Stores of one register.
            stores,
            /// Stores with an address of two registers, not right behind a load that they do not
            /// need.
            indexed_stores,
            /// Loads and stores whose address needs the arithmetic right before them.
            address_stalls,
            /// LDM, STM, PUSH, POP, LDRD and STRD, but those that load the program counter.
            multiples,
            /// The words that they move.
            multiple_words,
            /// POP and LDM that load the program counter.
            returns,
            /// The words that they move.
            return_words,
            /// Branches taken, with or without a condition.
            taken,
            /// Of these, the 16-bit ones right behind a 16-bit instruction that sets no flags.
            taken_folded,
            /// 16-bit branches not taken, right behind a 16-bit instruction.
            untaken_folded,
            /// BL; JAL, as a call or a jump.
            calls,
            /// BX, BLX, MOV and ADD to the program counter; JALR.
            register_jumps,
            /// Jumps to an address from a table: TBB, TBH, LDR to the program counter.
            table_jumps,
            /// Branches that the predictor of Hazard3 gets wrong.
            mispredictions,
            /// Jumps to a 32-bit instruction that does not begin at a word.
            split_targets,
            /// Products of 32 bits, or the upper 32 bits of one.
            multiplies,
            /// Of these, the 16-bit ones, which set flags.
            narrow_multiplies,
            /// Products of 64 bits; MULH.
            long_multiplies,
            /// Divisions and remainders.
            divides,
            /// Instructions that need the result of a shifted operand or a product right before
            /// them.
            late_uses,
            /// IT.
            its,
            /// Of these, the ones right behind a 16-bit instruction.
            its_folded,
            /// Instructions of the FPU, but those that load or store several registers.
            floats,
            /// Of these, the ones that load one register.
            float_loads,
            /// Of these, the ones that store one register.
            float_stores,
            /// Products that are added to or subtracted from a register of the FPU.
            float_multiply_adds,
            /// Quotients and square roots of the FPU.
            float_divides,
            /// Instructions that need the result of the FPU's arithmetic right before them.
            float_late_uses,
            /// Barriers, special registers, BKPT; CSR.
            systems,
            /// Lines of code that are not in the cache.
            fetch_misses,
            /// Loads from flash that are not in the cache.
            data_misses,
        }
    };
}

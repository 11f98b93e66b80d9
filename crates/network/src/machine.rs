//! Instruction sets. All sets with fused multiply-add give the same bits. The portable set also rounds each product, so the last digits differ.
//!
//! `taceva-metrics` selects instruction sets in the same way. In both crates, code in `simd/` proves that the CPU has the instructions.

use taceva_core::Isa;

#[cfg(target_arch = "aarch64")]
use crate::simd::Neon;
#[cfg(target_arch = "x86_64")]
use crate::simd::{Avx2, Avx512};
use crate::simd::{Job, Portable};

/// An instruction set detected on this machine.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Machine {
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    #[cfg(target_arch = "aarch64")]
    Neon(Neon),
    Portable(Portable),
}

impl Machine {
    /// Returns the machine with `isa`; `None` if the CPU lacks this instruction set.
    pub(crate) fn with(isa: Isa) -> Option<Machine> {
        match isa {
            #[cfg(target_arch = "x86_64")]
            Isa::Avx512 => Avx512::detect().map(Machine::Avx512),
            #[cfg(target_arch = "x86_64")]
            Isa::Avx2 => Avx2::detect().map(Machine::Avx2),
            #[cfg(target_arch = "aarch64")]
            Isa::Neon => Neon::detect().map(Machine::Neon),
            Isa::Portable => Some(Machine::Portable(Portable)),
            _ => None,
        }
    }

    /// Runs `job` with the vectors of this instruction set.
    #[inline]
    pub(crate) fn run<J: Job>(self, job: J) -> J::Output {
        match self {
            #[cfg(target_arch = "x86_64")]
            Machine::Avx512(proof) => proof.run(job),
            #[cfg(target_arch = "x86_64")]
            Machine::Avx2(proof) => proof.run(job),
            #[cfg(target_arch = "aarch64")]
            Machine::Neon(proof) => proof.run(job),
            Machine::Portable(proof) => proof.run(job),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_kernels_for_whatever_the_machine_is_said_to_have() {
        for isa in Isa::available() {
            assert!(Machine::with(isa).is_some(), "{isa}");
        }
    }
}

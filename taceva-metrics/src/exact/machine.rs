//! Instruction sets for sums. All compute the same bits and differ only in speed.
//!
//! `taceva-network` has its own similar file. Each instruction set is a type in `simd/`, with the operations that sums need. A value of the
//! type proves that the processor has the instructions.

use taceva_core::Isa;

#[cfg(target_arch = "aarch64")]
use super::simd::Neon;
use super::simd::Portable;
#[cfg(target_arch = "x86_64")]
use super::simd::{Avx2, Avx512};
use super::vector::Job;

/// Available instruction set.
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
    /// Machine that uses `isa`; `None` if this processor lacks it.
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

    /// Machine that uses the instruction set of [`Isa::detect`].
    pub(crate) fn detect() -> Machine {
        Machine::with(Isa::detect()).unwrap_or(Machine::Portable(Portable))
    }

    /// Runs `job` with the machine's vectors.
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

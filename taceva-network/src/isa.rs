//! Which instructions the passes are made with.

use std::fmt;
use std::sync::OnceLock;

#[cfg(target_arch = "aarch64")]
use crate::simd::Neon;
#[cfg(target_arch = "x86_64")]
use crate::simd::{Avx2, Avx512};
use crate::simd::{Job, Portable};

/// The environment variable that asks for an instruction set by name.
const VARIABLE: &str = "TACEVA_ISA";

/// An instruction set that there are kernels for.
///
/// Those with fused multiplication give the same bits; the portable one rounds products too and differs in last places. NEON
/// was written for 64-bit ARM and is compiled there only.
///
/// ```
/// use taceva_network::Isa;
/// assert!(Isa::Portable.is_available());
/// assert_eq!("portable".parse(), Ok(Isa::Portable));
/// assert!(Isa::available().contains(&Isa::detect()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Isa {
    /// AVX-512F: sixteen numbers at a time.
    Avx512,
    /// AVX2 and FMA: eight numbers at a time.
    Avx2,
    /// NEON: four numbers at a time.
    Neon,
    /// Whatever the compiler's target has, without fused multiplication.
    Portable,
}

impl Isa {
    /// Every instruction set, the widest vectors first.
    pub const ALL: [Isa; 4] = [Isa::Avx512, Isa::Avx2, Isa::Neon, Isa::Portable];

    /// The name in `TACEVA_ISA` and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Isa::Avx512 => "avx512",
            Isa::Avx2 => "avx2",
            Isa::Neon => "neon",
            Isa::Portable => "portable",
        }
    }

    /// The instruction set called `name`.
    ///
    /// # Errors
    /// [`IsaError::Unknown`] if none is.
    pub fn from_name(name: &str) -> Result<Isa, IsaError> {
        let named = Isa::ALL.into_iter().find(|isa| isa.name() == name);
        named.ok_or_else(|| IsaError::Unknown {
            name: name.to_owned(),
        })
    }

    /// Whether this machine has it.
    pub fn is_available(self) -> bool {
        Machine::with(self).is_some()
    }

    /// Those that this machine has, the fastest first.
    pub fn available() -> Vec<Isa> {
        Isa::ALL
            .into_iter()
            .filter(|isa| isa.is_available())
            .collect()
    }

    /// The one that passes are made with: what `TACEVA_ISA` asks for, or else the fastest that this machine has.
    ///
    /// The variable is read once in the life of a program. One that cannot be met is passed over here; a program that wants to
    /// refuse it asks [`requested`](Isa::requested).
    pub fn detect() -> Isa {
        static DETECTED: OnceLock<Isa> = OnceLock::new();
        *DETECTED.get_or_init(|| match Isa::requested() {
            Ok(Some(isa)) => isa,
            _ => Isa::fastest(),
        })
    }

    /// What the environment variable `TACEVA_ISA` asks for; `None` if it is not set.
    ///
    /// # Errors
    /// [`IsaError`] if it names no instruction set, or one that this machine has not.
    pub fn requested() -> Result<Option<Isa>, IsaError> {
        let Some(name) = std::env::var_os(VARIABLE) else {
            return Ok(None);
        };
        let isa = Isa::from_name(&name.to_string_lossy())?;
        isa.check().map(|()| Some(isa))
    }

    /// Whether this machine has it, as an error if not.
    fn check(self) -> Result<(), IsaError> {
        if self.is_available() {
            Ok(())
        } else {
            Err(IsaError::Unavailable { isa: self })
        }
    }

    fn fastest() -> Isa {
        let mut available = Isa::ALL.into_iter().filter(|isa| isa.is_available());
        available.next().unwrap_or(Isa::Portable)
    }
}

impl fmt::Display for Isa {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl std::str::FromStr for Isa {
    type Err = IsaError;

    fn from_str(name: &str) -> Result<Isa, IsaError> {
        Isa::from_name(name)
    }
}

/// Why an instruction set cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum IsaError {
    /// No instruction set is called so.
    Unknown {
        /// The name as given.
        name: String,
    },
    /// This machine does not have it.
    Unavailable {
        /// What was asked for.
        isa: Isa,
    },
}

impl fmt::Display for IsaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = |sets: &[Isa]| sets.iter().map(|isa| isa.name()).collect::<Vec<_>>();
        match self {
            IsaError::Unknown { name } => {
                let known = names(&Isa::ALL).join(", ");
                write!(f, "`{name}`: unknown instruction set, expected {known}")
            }
            IsaError::Unavailable { isa } => {
                let available = names(&Isa::available()).join(", ");
                write!(
                    f,
                    "`{isa}`: this machine does not have it, expected {available}"
                )
            }
        }
    }
}

impl std::error::Error for IsaError {}

/// An instruction set that the machine was found to have.
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
    /// The machine with `isa`, if it has it.
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

    /// Does `job` with the machine's vectors.
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
    fn names_lead_back_and_others_are_refused() {
        for isa in Isa::ALL {
            assert_eq!(Isa::from_name(isa.name()), Ok(isa));
        }
        let error = Isa::from_name("avx1024").expect_err("there is none");
        assert_eq!(
            error.to_string(),
            "`avx1024`: unknown instruction set, expected avx512, avx2, neon, portable"
        );
    }

    #[test]
    fn every_machine_has_the_portable_one_and_not_both_of_two_architectures() {
        assert!(Isa::Portable.is_available());
        assert!(!(Isa::Avx2.is_available() && Isa::Neon.is_available()));
        assert_eq!(Isa::available().last(), Some(&Isa::Portable));
    }
}

//! Instruction sets for vectorised loops.

use std::fmt;
use std::str::FromStr;
use std::sync::OnceLock;

use crate::display::display;

/// Environment variable with the name of an instruction set.
const VARIABLE: &str = "TACEVA_ISA";

/// An instruction set with specialised kernels.
///
/// The documentation of each kernel states if its results depend on the instruction set. NEON kernels are compiled for 64-bit ARM only.
///
/// ```
/// use taceva_core::Isa;
/// assert!(Isa::Portable.is_available());
/// assert_eq!("portable".parse(), Ok(Isa::Portable));
/// assert!(Isa::available().contains(&Isa::detect()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Isa {
    /// AVX-512F, FMA and POPCNT: vectors of 64 bytes.
    Avx512,
    /// AVX2, FMA and POPCNT: vectors of 32 bytes.
    Avx2,
    /// NEON: vectors of 16 bytes.
    Neon,
    /// Instructions of the compile target, without fused multiply-add.
    Portable,
}

impl Isa {
    /// Every instruction set, from the widest vectors to the narrowest.
    pub const ALL: [Isa; 4] = [Isa::Avx512, Isa::Avx2, Isa::Neon, Isa::Portable];

    /// Name in `TACEVA_ISA` and in reports.
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
    /// [`IsaError::Unknown`] if no instruction set has this name.
    pub fn from_name(name: &str) -> Result<Isa, IsaError> {
        let named = Isa::ALL.into_iter().find(|isa| isa.name() == name);
        named.ok_or_else(|| IsaError::Unknown {
            name: name.to_owned(),
        })
    }

    /// True if this machine has all processor features that kernels for this instruction set may use.
    pub fn is_available(self) -> bool {
        match self {
            #[cfg(target_arch = "x86_64")]
            Isa::Avx512 => {
                is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("fma")
                    && is_x86_feature_detected!("popcnt")
            }
            #[cfg(target_arch = "x86_64")]
            Isa::Avx2 => {
                is_x86_feature_detected!("avx2")
                    && is_x86_feature_detected!("fma")
                    && is_x86_feature_detected!("popcnt")
            }
            #[cfg(target_arch = "aarch64")]
            Isa::Neon => std::arch::is_aarch64_feature_detected!("neon"),
            Isa::Portable => true,
            _ => false,
        }
    }

    /// Instruction sets that this machine supports, from the widest vectors to the narrowest.
    pub fn available() -> Vec<Isa> {
        Isa::ALL
            .into_iter()
            .filter(|isa| isa.is_available())
            .collect()
    }

    /// Instruction set named by the environment variable `TACEVA_ISA`. Without a valid name, returns the supported set with the widest vectors.
    ///
    /// The variable is read once per process. A program that must reject an invalid name calls [`requested`](Isa::requested).
    pub fn detect() -> Isa {
        static DETECTED: OnceLock<Isa> = OnceLock::new();
        *DETECTED.get_or_init(|| match Isa::requested() {
            Ok(Some(isa)) => isa,
            _ => Isa::fastest(),
        })
    }

    /// Instruction set named by the environment variable `TACEVA_ISA`; `None` if the variable is not set.
    ///
    /// # Errors
    /// [`IsaError`] if the variable names an unknown instruction set, or an instruction set that this machine lacks.
    pub fn requested() -> Result<Option<Isa>, IsaError> {
        let Some(name) = std::env::var_os(VARIABLE) else {
            return Ok(None);
        };
        let isa = Isa::from_name(&name.to_string_lossy())?;
        if isa.is_available() {
            Ok(Some(isa))
        } else {
            Err(IsaError::Unavailable { isa })
        }
    }

    fn fastest() -> Isa {
        let mut available = Isa::ALL.into_iter().filter(|isa| isa.is_available());
        available.next().unwrap_or(Isa::Portable)
    }
}

display!(Isa, name);

impl FromStr for Isa {
    type Err = IsaError;

    fn from_str(name: &str) -> Result<Isa, IsaError> {
        Isa::from_name(name)
    }
}

/// Error in choosing an instruction set by name.
///
/// ```
/// use taceva_core::{Isa, IsaError};
/// assert_eq!(Isa::from_name("mmx"), Err(IsaError::Unknown { name: "mmx".to_owned() }));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum IsaError {
    /// No instruction set has the given name.
    Unknown {
        /// The given name.
        name: String,
    },
    /// This machine lacks the instruction set.
    Unavailable {
        /// The requested instruction set.
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
                    "`{isa}`: instruction set absent on this machine, expected {available}"
                )
            }
        }
    }
}

impl std::error::Error for IsaError {}

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

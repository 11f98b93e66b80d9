//! Four numbers per vector in plain Rust, for machines without an instruction set of ours.

#![expect(unsafe_code, reason = "loads and stores without bounds checks")]

use super::vector::{Job, Vector};

/// Stands where other instruction sets need evidence: every machine can run this.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

impl Portable {
    /// Does `job` with four numbers, which compilers turn into vectors of whatever the target has.
    pub(crate) fn run<J: Job>(self, job: J) -> J::Output {
        job.run::<Four>(self)
    }
}

/// Four numbers.
#[derive(Clone, Copy)]
struct Four([f32; 4]);

impl Vector for Four {
    type Proof = Portable;
    const LANES: usize = 4;
    // Sixteen registers of four are the least that targets have.
    const ROWS: usize = 2;
    const PANELS: usize = 1;

    #[inline(always)]
    fn zero(_proof: Portable) -> Four {
        Four([0.0; 4])
    }

    #[inline(always)]
    unsafe fn splat(_proof: Portable, place: *const f32) -> Four {
        // SAFETY: the caller promises a number at `place`.
        Four([unsafe { place.read() }; 4])
    }

    #[inline(always)]
    unsafe fn load(_proof: Portable, place: *const f32) -> Four {
        // SAFETY: the caller promises four numbers at `place`; an array of them is aligned as one is.
        Four(unsafe { place.cast::<[f32; 4]>().read() })
    }

    #[inline(always)]
    unsafe fn store(self, place: *mut f32) {
        // SAFETY: the caller promises room for four numbers at `place`; an array of them is aligned as one is.
        unsafe { place.cast::<[f32; 4]>().write(self.0) }
    }

    #[inline(always)]
    fn times_plus(self, factor: Four, addend: Four) -> Four {
        // Not `mul_add`, which without the instruction is a call that takes a hundred times longer.
        Four(std::array::from_fn(|lane| {
            self.0[lane] * factor.0[lane] + addend.0[lane]
        }))
    }

    #[inline(always)]
    fn plus(self, other: Four) -> Four {
        Four(std::array::from_fn(|lane| self.0[lane] + other.0[lane]))
    }

    #[inline(always)]
    fn positive_part(self) -> Four {
        Four(self.0.map(|value| if value < 0.0 { 0.0 } else { value }))
    }
}

//! Index of a radius in a table: fine near the contact, proportionally coarser farther out.
//!
//! Tables are indexed by t = 1 + (r/a)², with the radius r and the contact radius a. Each octave of t has equal cells, out to 64 contact radii. The
//! bits of the number give the position in the octave, without logarithm or square root. The rim of the contact, t = 2, is a node, so that a kink at
//! the rim is exact.

/// Number of cells in an octave; a power of two.
const CELLS: usize = 1 << CELL_BITS;
const CELL_BITS: u32 = 6;
/// Number of octaves of t = 1 + (r/a)² in a table, for the radius r and the contact radius a.
const OCTAVES: usize = 12;
/// Number of values in a table: one at each node, from the centre to 64 contact radii.
pub const NODES: usize = OCTAVES * CELLS + 1;

/// A function of the squared radius, with a value at each [`node`].
pub type Radial = [f32; NODES];

/// Bits of the fraction in a binary32.
const FRACTION_BITS: u32 = f32::MANTISSA_DIGITS - 1;
const CELL_SHIFT: u32 = FRACTION_BITS - CELL_BITS;

/// A position between two nodes of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Index of the lower node, at most `NODES - 2`.
    pub cell: usize,
    /// Position between the lower node and the next node, 0 to 1.
    pub fraction: f32,
}

impl Place {
    /// Value of `table` at this position, linear in r² between nodes.
    #[inline(always)]
    pub fn of(self, table: &Radial) -> f32 {
        let below = table[self.cell];
        below + self.fraction * (table[self.cell + 1] - below)
    }
}

/// Position of t = 1 + (r/a)² in a table, for the radius r and the contact radius a. Values beyond the table give the end of the table.
///
/// ```
/// use taceva_sim::displacement::{locate, node};
/// let place = locate(2.5);
/// assert_eq!((node(place.cell), place.fraction), (2.5, 0.0));
/// ```
#[inline(always)]
pub fn locate(t: f32) -> Place {
    let bits = t.to_bits();
    let cell = (bits >> CELL_SHIFT).wrapping_sub(1.0_f32.to_bits() >> CELL_SHIFT) as usize;
    if cell >= NODES - 1 {
        return Place {
            cell: NODES - 2,
            fraction: 1.0,
        };
    }
    let rest = bits & ((1 << CELL_SHIFT) - 1);
    let one_to_two = f32::from_bits((rest << CELL_BITS) | 1.0_f32.to_bits());
    Place {
        cell,
        fraction: one_to_two - 1.0,
    }
}

/// Value of t = 1 + (r/a)² at a node, for the radius r and the contact radius a.
pub fn node(position: usize) -> f64 {
    let octave = i32::try_from(position / CELLS).expect("tables have few octaves");
    let within = (position % CELLS) as f64 / CELLS as f64;
    libm::ldexp(1.0 + within, octave)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_is_found_at_its_own_place() {
        for position in 0..NODES - 1 {
            #[expect(
                clippy::cast_possible_truncation,
                reason = "nodes are exact in binary32"
            )]
            let place = locate(node(position) as f32);
            assert_eq!((place.cell, place.fraction.to_bits()), (position, 0));
        }
    }

    #[test]
    fn the_end_of_the_table_is_the_end_of_everything_beyond() {
        for t in [4096.0, 1e9, f32::INFINITY] {
            let place = locate(t);
            assert_eq!(
                (place.cell, place.fraction.to_bits()),
                (NODES - 2, 1.0_f32.to_bits())
            );
        }
    }

    #[test]
    fn between_nodes_a_table_is_linear_in_the_square_of_the_radius() {
        let table: Box<Radial> = Box::new(std::array::from_fn(|position| {
            #[expect(
                clippy::cast_possible_truncation,
                reason = "nodes are exact in binary32"
            )]
            let t = node(position) as f32;
            3.0 * t - 1.0
        }));
        for t in [1.0_f32, 1.003, 1.99, 2.01, 7.77, 500.5] {
            assert!(
                (locate(t).of(&table) - (3.0 * t - 1.0)).abs() < 2e-6 * t,
                "{t}"
            );
        }
    }
}

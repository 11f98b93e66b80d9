//! Lamps around a coated gel, and its shading.

use crate::number::narrow;
use crate::random::Stream;

/// A bar of light next to the gel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LampSpec {
    /// Centre of the bar: x, y, and its height over the gel, on the side of the camera.
    pub middle_mm: [f64; 3],
    /// Half the length of the bar along x and y.
    pub half_length_mm: [f64; 2],
    /// Red, green and blue light of the bar on a gel that faces the bar at the reach of the lamps, DN.
    pub colour_dn: [f64; 3],
}

/// A bar of light, in the types of the inner loop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamp {
    pub(super) low: [f32; 2],
    pub(super) high: [f32; 2],
    pub(super) height: f32,
    pub(super) colour: [f32; 3],
}

/// Number of pixels shaded together.
pub(super) const CHUNK: usize = 32;

/// Slopes of the coating under a run of pixels of one row, as the camera sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slopes {
    /// Slope towards the camera along x; the next field is the slope along y.
    pub(super) x: [f32; CHUNK],
    pub(super) y: [f32; CHUNK],
    /// Darkness of the shadow of the contact, divided by the distance from the centre of the contact, 1/mm; 0 outside the shadow.
    pub(super) shadow: [f32; CHUNK],
    /// Component of the unit normal of the surface along the sensor's axis.
    pub(super) upright: [f32; CHUNK],
}

impl Slopes {
    /// Computes `upright` from the slopes.
    #[inline(always)]
    pub(super) fn measure(&mut self) {
        for i in 0..CHUNK {
            let squared = self.x[i] * self.x[i] + self.y[i] * self.y[i];
            self.upright[i] = 1.0 / (1.0 + squared).sqrt();
        }
    }
}

/// Origin of a shadow.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Caster {
    pub(super) x: f32,
    pub(super) y: f32,
}

impl Lamp {
    /// Creates a lamp with the `gain` of this unit.
    pub(super) fn new(spec: &LampSpec, reach_mm: f64, gain: f64) -> Lamp {
        let end = |axis: usize, side: f64| {
            narrow(spec.middle_mm[axis] + side * spec.half_length_mm[axis])
        };
        Lamp {
            low: [end(0, -1.0), end(1, -1.0)],
            high: [end(0, 1.0), end(1, 1.0)],
            height: narrow(spec.middle_mm[2]),
            colour: spec.colour_dn.map(|dn| narrow(dn * reach_mm * gain)),
        }
    }

    /// Gain of lamp `number` of a unit: random with mean 1 and standard deviation `spread`.
    pub(super) fn gain(stream: &Stream, number: u64, spread: f64) -> f64 {
        1.0 + spread * stream.normal(number)
    }

    /// Adds the light of the lamp to red, green and blue of the pixels at `x`, `y`.
    ///
    /// I = ρ (d₀/d) max(0, n·l). Here ρ is the light of the lamp at the reach d₀, d the distance to the nearest point of the bar, l the unit vector
    /// to this point, and n ∝ (−Hx, −Hy, 1) the normal for the slopes Hx and Hy. With the vector L = d l, this is ρ d₀ max(0, n·L) / d². Only the
    /// length of n then needs a root.
    #[inline(always)]
    pub(super) fn light(
        &self,
        x: &[f32; CHUNK],
        y: f32,
        slopes: &Slopes,
        caster: Caster,
        colours: &mut [[f32; CHUNK]; 3],
    ) {
        let ahead_y = clamp(y, self.low[1], self.high[1]) - y;
        let ahead_z = self.height;
        let away = ahead_y * ahead_y + ahead_z * ahead_z;
        // Direction of the shadow, from the contact away from the lamp.
        let to_lamp = [
            clamp(caster.x, self.low[0], self.high[0]) - caster.x,
            clamp(caster.y, self.low[1], self.high[1]) - caster.y,
        ];
        let length = (to_lamp[0] * to_lamp[0] + to_lamp[1] * to_lamp[1]).sqrt();
        let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
        let behind = [-to_lamp[0] * inverse, -to_lamp[1] * inverse];
        let behind_y = (y - caster.y) * behind[1];
        let [strength_red, strength_green, strength_blue] = self.colour;
        let [red, green, blue] = colours;
        for i in 0..CHUNK {
            let ahead_x = clamp(x[i], self.low[0], self.high[0]) - x[i];
            let facing = ahead_z - slopes.x[i] * ahead_x - slopes.y[i] * ahead_y;
            let facing = if facing > 0.0 { facing } else { 0.0 };
            let lit = facing * slopes.upright[i] / (ahead_x * ahead_x + away);
            let behind = (x[i] - caster.x) * behind[0] + behind_y;
            let behind = if behind > 0.0 { behind } else { 0.0 };
            let lit = lit * (1.0 - slopes.shadow[i] * behind);
            red[i] += lit * strength_red;
            green[i] += lit * strength_green;
            blue[i] += lit * strength_blue;
        }
    }
}

#[inline(always)]
fn clamp(value: f32, low: f32, high: f32) -> f32 {
    let value = if value > low { value } else { low };
    if value < high { value } else { high }
}

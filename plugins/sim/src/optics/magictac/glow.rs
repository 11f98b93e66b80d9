//! Light in the block: from its own lamps and from outside.

use super::spec::MagictacSpec;
use crate::optics::ambient::AmbientLight;
use crate::random::Stream;

/// Light of the lamps at a place: red, green, blue, in DN.
#[derive(Clone, Copy, Debug)]
pub(super) struct Glow {
    strength: [f64; 3],
    everywhere: f64,
}

/// For each lamp: the centre of its glow, twice its variance in mm², and its relative strength.
const LAMPS: [([f64; 2], f64, f64); 3] = [
    ([6.0, -8.0], 120.0, 1.0),
    ([-6.0, -4.0], 140.0, 0.9),
    ([-2.0, 9.0], 130.0, 1.0),
];

impl Glow {
    /// Light of a unit's lamps, with gains drawn from `gains`.
    pub(super) fn new(spec: &MagictacSpec, gains: &Stream) -> Glow {
        let mut strength = [0.0; 3];
        for ((strength, (_, _, beside)), number) in strength.iter_mut().zip(LAMPS).zip(0..) {
            let gain = 1.0 + spec.lamp_gain_spread * gains.normal(number);
            *strength = spec.glow_dn[0] * beside * gain;
        }
        Glow {
            strength,
            everywhere: spec.glow_dn[1],
        }
    }

    /// Light at `x`, `y`.
    pub(super) fn at(&self, x: f64, y: f64) -> [f64; 3] {
        std::array::from_fn(|colour| {
            let ([lamp_x, lamp_y], spread, _) = LAMPS[colour];
            let squared = (x - lamp_x) * (x - lamp_x) + (y - lamp_y) * (y - lamp_y);
            self.everywhere + self.strength[colour] * libm::exp(-squared / spread)
        })
    }
}

/// Effect of a light scene: additional light, and the automatic exposure of the camera.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outside {
    scene: AmbientLight,
}

impl Outside {
    /// Creates the effect of `scene` on the pictures of the camera.
    pub(super) fn new(scene: AmbientLight) -> Outside {
        Outside { scene }
    }

    /// Factor of the camera's automatic exposure, fitted to mean grays of 107, 107, 105 and 118 DN under scenes S1 to S4. Without a scene, the mean
    /// gray is 107 DN.
    pub(super) fn exposure(&self) -> f64 {
        match self.scene {
            AmbientLight::Normal | AmbientLight::Spot => 1.0,
            AmbientLight::Ceiling => 0.985,
            AmbientLight::WideBeam => 0.97,
            AmbientLight::Ring => 0.93,
        }
    }

    /// Additional light at `x`, `y`: red, green, blue, in DN. Its shape is a free parameter, its strength is fitted.
    pub(super) fn at(&self, x: f64, y: f64) -> [f64; 3] {
        match self.scene {
            AmbientLight::Normal => [0.0; 3],
            AmbientLight::Ceiling => [1.6; 3],
            AmbientLight::WideBeam => {
                let across = (x - 8.0) / 6.0;
                [8.7 * libm::exp(-across * across); 3]
            }
            AmbientLight::Ring => {
                let from_ring = ((x * x + y * y).sqrt() - 3.0) / 5.0;
                let ring = 10.5 * libm::exp(-from_ring * from_ring);
                [ring, 0.9 * ring, 0.8 * ring]
            }
            AmbientLight::Spot => {
                let squared = x * x + (y - 6.0) * (y - 6.0);
                [69.0 * libm::exp(-squared / 18.0); 3]
            }
        }
    }
}

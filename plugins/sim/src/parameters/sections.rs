//! The sections of a parameter table.

use super::section::{Row, Section, section};
use crate::elastic::layer;

section! {
    /// A flat gel bonded to a rigid plate.
    Layer, "layer", {
        /// Thickness of the gel.
        thickness_mm: "mm", 1.0 ..= 100.0;
        /// Young's modulus of the gel.
        young_modulus_mpa: "MPa", 0.001 ..= 100.0;
        /// Poisson's ratio; the force law is made for incompressible gels.
        poisson_ratio: "1", 0.5 ..= 0.5;
        /// How much stiffer a lattice gets a millimetre of depth, as it closes.
        stiffening_per_mm: "1/mm", 0.0 ..= 10.0;
    }
}

impl Layer {
    /// The deepest that the force law holds for, with a ball of `radius_mm`.
    pub(super) fn greatest_depth_mm(thickness_mm: f64, radius_mm: f64) -> f64 {
        (layer::CHI_MAX * thickness_mm).powi(2) / radius_mm
    }
}

section! {
    /// A skin over a soft hemisphere.
    Dome, "dome", {
        /// Radius of the dome.
        radius_mm: "mm", 5.0 ..= 200.0;
        /// Force a depth of the skin, buckled where it is pressed.
        skin_n_per_mm: "N/mm", 0.0 ..= 100.0;
        /// Force a depth to the power of 3/2 of the gel under it, with a ball of 2 mm.
        gel_n_per_mm_3_2: "N/mm^1.5", 0.0001 ..= 100.0;
        /// Thickness of the skin.
        skin_thickness_mm: "mm", 0.05 ..= 10.0;
        /// Tangential over normal stiffness.
        tangential_ratio: "1", 0.0 ..= 1.0;
        /// How far the whole dome gives way sideways.
        sway_mm_per_n: "mm/N", 0.0 ..= 10.0;
    }
}

section! {
    /// What the indenter touches.
    Surface, "surface", {
        /// Coulomb's coefficient of friction against the indenter.
        friction: "1", 0.0 ..= 5.0;
        /// Width of what the camera sees; the diameter on a dome.
        width_mm: "mm", 1.0 ..= 500.0;
        /// Height of what the camera sees; the diameter on a dome.
        height_mm: "mm", 1.0 ..= 500.0;
        /// How much lower a flat surface lies 7 mm out along x.
        sag_x_mm: "mm", 0.0 ..= 5.0;
        /// How much lower a flat surface lies 9 mm out along y.
        sag_y_mm: "mm", 0.0 ..= 5.0;
        /// How much softer the gel is at its free edge, as a fraction.
        edge_softening: "1", 0.0 ..= 0.9;
    }
}

section! {
    /// How the gel forgets.
    Material, "material", {
        /// The fraction of the force that relaxes.
        relaxing_fraction: "1", 0.0 ..= 0.95;
        /// The time in which it relaxes to 1/e.
        relaxation_time_s: "s", 0.001 ..= 100000.0;
        /// The fraction of the force that a gel loses below a depth it was pressed to before.
        conditioning_fraction: "1", 0.0 ..= 0.5;
        /// The number of presses in which it loses it, to 1/e.
        conditioning_presses: "1", 0.1 ..= 1000.0;
    }
}

section! {
    /// Where and how deep the sensor may be pressed.
    Probing, "probing", {
        /// Half the width of the probed surface; its radius on a dome.
        half_width_mm: "mm", 0.5 ..= 250.0;
        /// Half the height of the probed surface; its radius on a dome.
        half_height_mm: "mm", 0.5 ..= 250.0;
        /// Least travel after contact.
        depth_min_mm: "mm", 0.0 ..= 50.0;
        /// Greatest travel after contact.
        depth_max_mm: "mm", 0.01 ..= 50.0;
        /// Greatest shear along x and along y.
        shear_max_mm: "mm", 0.0 ..= 50.0;
        /// The normal force at which a press stops.
        force_max_n: "N", 0.01 ..= 1000.0;
    }
}

section! {
    /// How units and places differ.
    Variation, "variation", {
        /// Standard deviation of the stiffness from place to place, as a fraction.
        stiffness: "1", 0.0 ..= 0.5;
        /// Standard deviation of the modulus from unit to unit, as a fraction; unit 0 is nominal.
        modulus: "1", 0.0 ..= 0.5;
        /// Standard deviation of the sag from unit to unit, as a fraction; unit 0 is nominal.
        sag: "1", 0.0 ..= 0.5;
        /// Root mean square of how the surface of a unit waves.
        gap_mm: "mm", 0.0 ..= 1.0;
        /// Height of the largest blister a unit may have.
        blister_mm: "mm", 0.0 ..= 5.0;
    }
}

section! {
    /// What the camera of the sensor gives.
    Camera, "camera", {
        /// Pixels a row of the native picture.
        width_px: "px", 16.0 ..= 16384.0;
        /// Rows of the native picture.
        height_px: "px", 16.0 ..= 16384.0;
        /// Pictures a second.
        rate_hz: "Hz", 0.1 ..= 10000.0;
        /// Channels: 1 for gray, 3 for colour.
        channels: "1", 1.0 ..= 3.0;
        /// 1 if light from outside reaches the camera, 0 if the gel is opaque.
        transparency: "1", 0.0 ..= 1.0;
        /// Mean of an undisturbed picture in the dark, in steps of an 8-bit camera.
        mean_gray: "DN", 0.0 ..= 255.0;
        /// Variance of the shot noise a step of brightness, in a picture 96 pixels wide.
        shot_gain: "DN", 0.0 ..= 10.0;
        /// Standard deviation of the read noise, in a picture 96 pixels wide.
        read_noise: "DN", 0.0 ..= 50.0;
        /// Standard deviation of the brightness from picture to picture, as a fraction.
        flicker: "1", 0.0 ..= 0.2;
    }
}

section! {
    /// What is printed in or on the gel.
    Markers, "markers", {
        /// Distance between neighbours.
        pitch_mm: "mm", 0.1 ..= 50.0;
        /// Diameter of one.
        diameter_mm: "mm", 0.05 ..= 20.0;
        /// Standard deviation of the places of a unit's markers.
        jitter_mm: "mm", 0.0 ..= 1.0;
        /// Markers a row; on a dome, rings of a hexagon around the central one.
        columns: "1", 1.0 ..= 200.0;
        /// Rows; on a dome, the same as the rings.
        rows: "1", 1.0 ..= 200.0;
    }
}

section! {
    /// The layers of a printed lattice.
    Lattice, "lattice", {
        /// Depth of the first layer.
        first_depth_mm: "mm", 0.05 ..= 50.0;
        /// Depth of the second layer.
        second_depth_mm: "mm", 0.05 ..= 50.0;
        /// Depth of the third layer.
        third_depth_mm: "mm", 0.05 ..= 50.0;
        /// Pitch of the lattice.
        pitch_mm: "mm", 0.1 ..= 50.0;
        /// How far cells buckle out of their way, as a fraction of the displacement.
        buckling: "1", 0.0 ..= 1.0;
    }
}

section! {
    /// How gratings are seen.
    Gratings, "gratings", {
        /// Standard deviation of the blur between relief and camera.
        blur_mm: "mm", 0.0 ..= 5.0;
        /// Contrast over noise of a pixel on a coarse grating.
        contrast: "1", 0.0 ..= 1000.0;
    }
}

section! {
    /// What moves the indenter.
    Robot, "robot", {
        /// Standard deviation of where it stands, an axis.
        positioning_mm: "mm", 0.0 ..= 1.0;
        /// Speed of approach and indentation.
        speed_mm_per_s: "mm/s", 0.001 ..= 1000.0;
    }
}

section! {
    /// How contact is found.
    Search, "search", {
        /// How far the robot moves between two readings.
        step_mm: "mm", 0.001 ..= 5.0;
        /// The force that is called contact.
        threshold_n: "N", 0.0001 ..= 10.0;
    }
}

section! {
    /// What measures the force.
    Transducer, "transducer", {
        /// Standard deviation of a reading, after averaging.
        noise_n: "N", 0.0 ..= 10.0;
        /// Standard deviation of the zero from point to point.
        point_drift_n: "N", 0.0 ..= 10.0;
        /// Standard deviation of the zero from press to press.
        press_drift_n: "N", 0.0 ..= 10.0;
        /// The greatest fraction of one component that shows in another.
        cross_talk: "1", 0.0 ..= 0.2;
        /// The greatest force it can measure.
        range_n: "N", 0.1 ..= 100000.0;
    }
}

//! Sections of a parameter table.

use super::section::{Row, Section, section};
use crate::elastic::layer;

section! {
    /// A flat gel bonded to a rigid plate.
    Layer, "layer", {
        /// Thickness of the gel.
        thickness_mm: "mm", 1.0 ..= 100.0;
        /// Young's modulus of the gel.
        young_modulus_mpa: "MPa", 0.001 ..= 100.0;
        /// Poisson's ratio. The force law is valid only for incompressible gels.
        poisson_ratio: "1", 0.5 ..= 0.5;
        /// Relative stiffening of a closing lattice per millimetre of depth.
        stiffening_per_mm: "1/mm", 0.0 ..= 10.0;
    }
}

impl Layer {
    /// Maximum depth for which the force law is valid with a ball of `radius_mm`, mm.
    pub(super) fn greatest_depth_mm(thickness_mm: f64, radius_mm: f64) -> f64 {
        (layer::CHI_MAX * thickness_mm).powi(2) / radius_mm
    }
}

section! {
    /// A skin over a soft hemisphere.
    Dome, "dome", {
        /// Radius of the dome.
        radius_mm: "mm", 5.0 ..= 200.0;
        /// Linear stiffness of the skin, which buckles under the load.
        skin_n_per_mm: "N/mm", 0.0 ..= 100.0;
        /// Coefficient of depth^(3/2) in the force of the gel under the skin, for a ball of 2 mm radius.
        gel_n_per_mm_3_2: "N/mm^1.5", 0.0001 ..= 100.0;
        /// Thickness of the skin.
        skin_thickness_mm: "mm", 0.05 ..= 10.0;
        /// Ratio of tangential to normal stiffness.
        tangential_ratio: "1", 0.0 ..= 1.0;
        /// Sway of the whole dome per lateral force.
        sway_mm_per_n: "mm/N", 0.0 ..= 10.0;
    }
}

section! {
    /// Surface under the indenter.
    Surface, "surface", {
        /// Coulomb's coefficient of friction against the indenter.
        friction: "1", 0.0 ..= 5.0;
        /// Width of the visible field; the diameter on a dome.
        width_mm: "mm", 1.0 ..= 500.0;
        /// Height of the visible field; the diameter on a dome.
        height_mm: "mm", 1.0 ..= 500.0;
        /// Sag of a flat surface 7 mm out along x.
        sag_x_mm: "mm", 0.0 ..= 5.0;
        /// Sag of a flat surface 9 mm out along y.
        sag_y_mm: "mm", 0.0 ..= 5.0;
        /// Relative softening of the gel at its free edge.
        edge_softening: "1", 0.0 ..= 0.9;
    }
}

section! {
    /// Relaxation and conditioning of the gel.
    Material, "material", {
        /// Fraction of the force that relaxes.
        relaxing_fraction: "1", 0.0 ..= 0.95;
        /// Time constant of the relaxation.
        relaxation_time_s: "s", 0.001 ..= 100000.0;
        /// Greatest fraction of the force that earlier presses take from a gel, down to their depth.
        conditioning_fraction: "1", 0.0 ..= 0.5;
        /// Number of presses after which the loss has reached 1 − 1/e of its limit.
        conditioning_presses: "1", 0.1 ..= 1000.0;
    }
}

section! {
    /// Probed surface, depths and forces.
    Probing, "probing", {
        /// Half the width of the probed surface; its radius on a dome.
        half_width_mm: "mm", 0.5 ..= 250.0;
        /// Half the height of the probed surface; its radius on a dome.
        half_height_mm: "mm", 0.5 ..= 250.0;
        /// Minimum travel after contact.
        depth_min_mm: "mm", 0.0 ..= 50.0;
        /// Maximum travel after contact.
        depth_max_mm: "mm", 0.01 ..= 50.0;
        /// Maximum shear along x and along y.
        shear_max_mm: "mm", 0.0 ..= 50.0;
        /// Normal force that ends a press.
        force_max_n: "N", 0.01 ..= 1000.0;
    }
}

section! {
    /// Variation of stiffness, modulus, sag and surface between units and places.
    Variation, "variation", {
        /// Relative standard deviation of the stiffness between places.
        stiffness: "1", 0.0 ..= 0.5;
        /// Relative standard deviation of the modulus between units. Unit 0 is nominal.
        modulus: "1", 0.0 ..= 0.5;
        /// Relative standard deviation of the sag between units. Unit 0 is nominal.
        sag: "1", 0.0 ..= 0.5;
        /// Root-mean-square height of the waves on the surface of a unit.
        gap_mm: "mm", 0.0 ..= 1.0;
        /// Height of the largest blister a unit may have.
        blister_mm: "mm", 0.0 ..= 5.0;
    }
}

section! {
    /// Camera of the sensor.
    Camera, "camera", {
        /// Width of the native picture.
        width_px: "px", 16.0 ..= 16384.0;
        /// Height of the native picture.
        height_px: "px", 16.0 ..= 16384.0;
        /// Frame rate.
        rate_hz: "Hz", 0.1 ..= 10000.0;
        /// Channels: 1 for gray, 3 for colour.
        channels: "1", 1.0 ..= 3.0;
        /// 1 if ambient light reaches the camera, 0 if the gel is opaque.
        transparency: "1", 0.0 ..= 1.0;
        /// Mean gray over the pixels of an untouched picture in the dark, DN of an 8-bit camera.
        mean_gray: "DN", 0.0 ..= 255.0;
        /// Variance of the shot noise per DN of brightness, in a picture 96 pixels wide.
        shot_gain: "DN", 0.0 ..= 10.0;
        /// Standard deviation of the read noise, in a picture 96 pixels wide.
        read_noise: "DN", 0.0 ..= 50.0;
        /// Relative standard deviation of the brightness between pictures.
        flicker: "1", 0.0 ..= 0.2;
    }
}

section! {
    /// Markers in or on the gel.
    Markers, "markers", {
        /// Distance between neighbouring markers.
        pitch_mm: "mm", 0.1 ..= 50.0;
        /// Diameter of a marker.
        diameter_mm: "mm", 0.05 ..= 20.0;
        /// Standard deviation of the marker places of a unit.
        jitter_mm: "mm", 0.0 ..= 1.0;
        /// Number of markers in a row; on a dome, of rings of a hexagon around the central marker.
        columns: "1", 1.0 ..= 200.0;
        /// Number of rows; on a dome, equal to the number of rings.
        rows: "1", 1.0 ..= 200.0;
    }
}

section! {
    /// Layers of a printed lattice.
    Lattice, "lattice", {
        /// Depth of the first layer below the surface.
        first_depth_mm: "mm", 0.05 ..= 50.0;
        /// Depth of the second layer below the surface.
        second_depth_mm: "mm", 0.05 ..= 50.0;
        /// Depth of the third layer below the surface.
        third_depth_mm: "mm", 0.05 ..= 50.0;
        /// Pitch of the lattice.
        pitch_mm: "mm", 0.1 ..= 50.0;
        /// Buckling of cells, as a fraction of the displacement.
        buckling: "1", 0.0 ..= 1.0;
    }
}

section! {
    /// Wear of the gel. A new gel has no such section.
    GelWear, "wear", {
        /// Shift of the gel in its housing along x; along y, half of it.
        shift_mm: "mm", 0.0 ..= 5.0;
        /// Relative gain of the light that the coating reflects in one direction.
        gloss: "1", 0.0 ..= 3.0;
        /// Number of bright scratches.
        scratches: "1", 0.0 ..= 500.0;
        /// Radius of a dark tear; 0 for none.
        tear_radius_mm: "mm", 0.0 ..= 100.0;
        /// Number of dark specks of dust.
        dust: "1", 0.0 ..= 500.0;
    }
}

section! {
    /// Ageing of the gel by presses. A gel without this section does not age.
    Ageing, "ageing", {
        /// Rate at which the gel loses stiffness, per kilonewton of the sum of the forces of all presses. Negative if the gel hardens.
        softening_per_kn: "1/kN", -10.0 ..= 100.0;
        /// Rate at which the surface loses friction and gains gloss, per kilonewton of the sum of the forces of all presses.
        polishing_per_kn: "1/kN", 0.0 ..= 100.0;
    }
}

impl GelWear {
    /// A gel without wear.
    pub(super) const NONE: GelWear = GelWear {
        shift_mm: 0.0,
        gloss: 0.0,
        scratches: 0.0,
        tear_radius_mm: 0.0,
        dust: 0.0,
    };

    /// Shift of the gel along x and y, mm.
    pub fn shift_xy_mm(&self) -> [f64; 2] {
        [self.shift_mm, 0.5 * self.shift_mm]
    }
}

section! {
    /// Blur and contrast of gratings.
    Gratings, "gratings", {
        /// Standard deviation of the blur between relief and camera.
        blur_mm: "mm", 0.0 ..= 5.0;
        /// Contrast of a coarse grating, relative to the noise of a pixel.
        contrast: "1", 0.0 ..= 1000.0;
    }
}

section! {
    /// Robot that moves the indenter.
    Robot, "robot", {
        /// Standard deviation of the position error along each axis.
        positioning_mm: "mm", 0.0 ..= 1.0;
        /// Speed of approach and indentation.
        speed_mm_per_s: "mm/s", 0.001 ..= 1000.0;
    }
}

section! {
    /// Search for first contact.
    Search, "search", {
        /// Distance that the indenter moves between two readings.
        step_mm: "mm", 0.001 ..= 5.0;
        /// Force that counts as contact.
        threshold_n: "N", 0.0001 ..= 10.0;
    }
}

section! {
    /// Force transducer.
    Transducer, "transducer", {
        /// Standard deviation of a reading, after averaging.
        noise_n: "N", 0.0 ..= 10.0;
        /// Standard deviation of the zero offset between points.
        point_drift_n: "N", 0.0 ..= 10.0;
        /// Standard deviation of the zero offset between presses.
        press_drift_n: "N", 0.0 ..= 10.0;
        /// Maximum fraction of one component that appears in another.
        cross_talk: "1", 0.0 ..= 0.2;
        /// Maximum measurable force.
        range_n: "N", 0.1 ..= 100000.0;
    }
}

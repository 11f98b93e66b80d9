//! Encoding of driver descriptions. The receiver checks the descriptions again.

use taceva_core::{
    ArgKind, ArgSpec, ChangerFacts, Descriptor, DescriptorSpec, DriverKey, DriverSource, Facts,
    Footprint, ForceFacts, LightingFacts, Outline, Presence, RobotFacts, SensorFacts, Workspace,
};

use super::value::listed;
use super::{Malformed, Reader, Wire, fields};

listed! {
    DriverSource, [DriverSource::Real, DriverSource::Simulated, DriverSource::Recorded], "a source of readings";
}

/// Implements [`Wire`] for a struct that can get further fields, as [`fields`] does for a fixed struct. The compiler cannot detect a missing field
/// here; the test `facts_that_can_grow_cross_with_every_field` does.
macro_rules! growing {
    ($type:ident { $($field:ident),* $(,)? }) => {
        impl Wire for $type {
            fn write(&self, into: &mut Vec<u8>) {
                $(self.$field.write(into);)*
            }

            fn read(from: &mut Reader<'_>) -> Result<$type, Malformed> {
                let mut facts = $type::default();
                $(facts.$field = Wire::read(from)?;)*
                Ok(facts)
            }
        }

        #[cfg(test)]
        impl tests::Growing for $type {
            const FIELDS: &'static [&'static str] = &[$(stringify!($field)),*];
        }
    };
}

fields!(Workspace { least, greatest });
growing!(RobotFacts {
    workspace,
    speed_max,
    repeatability,
    pose_noise,
    deceleration_mm_s2,
    stop_ms,
    latency_ms,
    guarded_motion,
    base_frame
});
growing!(ForceFacts {
    axes,
    rate,
    force_max,
    noise,
    resolution,
    latency_ms,
    numbered,
    tare
});
growing!(LightingFacts { scenes });
growing!(ChangerFacts { holds });
growing!(SensorFacts {
    frame,
    rate,
    opaque,
    markers,
    scenes,
    footprint,
    depth_max,
    force_max,
    camera,
    gel_thickness,
    field_of_view_mm2,
    latency_ms
});

impl Wire for ArgSpec {
    fn write(&self, into: &mut Vec<u8>) {
        self.key.write(into);
        self.kind.write(into);
        self.unit.write(into);
        self.presence.write(into);
        self.help.write(into);
        self.changes_facts.write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<ArgSpec, Malformed> {
        let key = String::read(from)?;
        let mut spec = ArgSpec::new(&key, Wire::read(from)?);
        spec.unit = Wire::read(from)?;
        spec.presence = Wire::read(from)?;
        spec.help = Wire::read(from)?;
        spec.changes_facts = Wire::read(from)?;
        Ok(spec)
    }
}

impl Wire for [u32; 2] {
    fn write(&self, into: &mut Vec<u8>) {
        (self[0], self[1]).write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<[u32; 2], Malformed> {
        Ok([u32::read(from)?, u32::read(from)?])
    }
}

impl Wire for DriverKey {
    fn write(&self, into: &mut Vec<u8>) {
        self.as_str().to_owned().write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<DriverKey, Malformed> {
        String::read(from)?
            .parse()
            .map_err(|_| from.malformed("the key of a driver"))
    }
}

impl Wire for Footprint {
    fn write(&self, into: &mut Vec<u8>) {
        // An unknown outline gets a tag that every reader rejects.
        let (tag, [x, y]) = match self.outline() {
            Outline::Disc { .. } => (0_u8, self.half_extent()),
            Outline::Rectangle { .. } => (1, self.half_extent()),
            _ => (u8::MAX, self.half_extent()),
        };
        tag.write(into);
        (x.to_millimetres(), y.to_millimetres()).write(into);
        self.depth_max()
            .map(|depth| depth.to_millimetres())
            .write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<Footprint, Malformed> {
        let tag = u8::read(from)?;
        let (x, y) = <(f64, f64)>::read(from)?;
        let depth_max = Option::<f64>::read(from)?;
        let footprint = match tag {
            0 => Footprint::disc(x, depth_max),
            1 => Footprint::rectangle(x, y, depth_max),
            _ => return Err(from.malformed("an outline")),
        };
        footprint.map_err(|_| from.malformed("the lengths of a footprint"))
    }
}

impl Wire for Facts {
    fn write(&self, into: &mut Vec<u8>) {
        self.kind().write(into);
        match self {
            Facts::Sensor(facts) => facts.write(into),
            Facts::Robot(facts) => facts.write(into),
            Facts::Force(facts) => facts.write(into),
            Facts::Lighting(facts) => facts.write(into),
            Facts::Changer(facts) => facts.write(into),
            // Unknown facts have a kind that every reader rejects.
            _ => {}
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Facts, Malformed> {
        use taceva_core::DriverKind;
        Ok(match DriverKind::read(from)? {
            DriverKind::Sensor => Facts::Sensor(Box::new(Wire::read(from)?)),
            DriverKind::Robot => Facts::Robot(Wire::read(from)?),
            DriverKind::Force => Facts::Force(Wire::read(from)?),
            DriverKind::Lighting => Facts::Lighting(Wire::read(from)?),
            DriverKind::Changer => Facts::Changer(Wire::read(from)?),
            _ => return Err(from.malformed("facts")),
        })
    }
}

impl Wire for ArgKind {
    fn write(&self, into: &mut Vec<u8>) {
        match self {
            ArgKind::Text => 0_u8.write(into),
            ArgKind::Path => 1_u8.write(into),
            ArgKind::Whole { least, most } => (2_u8, (*least, *most)).write(into),
            ArgKind::Number { least, most } => (3_u8, (*least, *most)).write(into),
            ArgKind::Choice { of } => (4_u8, of.clone()).write(into),
            ArgKind::Flag => 5_u8.write(into),
            // An unknown kind gets a tag that every reader rejects.
            _ => u8::MAX.write(into),
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<ArgKind, Malformed> {
        Ok(match u8::read(from)? {
            0 => ArgKind::Text,
            1 => ArgKind::Path,
            2 => ArgKind::Whole {
                least: Wire::read(from)?,
                most: Wire::read(from)?,
            },
            3 => ArgKind::Number {
                least: Wire::read(from)?,
                most: Wire::read(from)?,
            },
            4 => ArgKind::Choice {
                of: Wire::read(from)?,
            },
            5 => ArgKind::Flag,
            _ => return Err(from.malformed("a type of argument")),
        })
    }
}

impl Wire for Presence {
    fn write(&self, into: &mut Vec<u8>) {
        match self {
            Presence::Required => 0_u8.write(into),
            Presence::Optional => 1_u8.write(into),
            Presence::Default(value) => (2_u8, value.clone()).write(into),
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Presence, Malformed> {
        Ok(match u8::read(from)? {
            0 => Presence::Required,
            1 => Presence::Optional,
            2 => Presence::Default(Wire::read(from)?),
            _ => return Err(from.malformed("a known kind of requirement of an argument")),
        })
    }
}

impl Wire for Descriptor {
    fn write(&self, into: &mut Vec<u8>) {
        self.key().write(into);
        self.title().to_owned().write(into);
        self.source().write(into);
        self.facts().write(into);
        self.arguments().to_vec().write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<Descriptor, Malformed> {
        let key = Wire::read(from)?;
        let title = String::read(from)?;
        let spec = DescriptorSpec::new(key, title, Wire::read(from)?, Wire::read(from)?);
        spec.arguments(Vec::<ArgSpec>::read(from)?)
            .check()
            .map_err(|_| from.malformed("a consistent description"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::child::wire::{decode, encode};
    use taceva_core::{Device, ForceTransducer, Lighting, Registry, Robot, Sensor};
    use taceva_sim as _;

    /// Facts that are encoded field by field.
    pub(super) trait Growing: Default + std::fmt::Debug {
        /// Names of the encoded fields, in order.
        const FIELDS: &'static [&'static str];
    }

    /// Names of the fields of the struct, in declaration order, from the output of `Debug`. That output has one field per line, indented by four
    /// spaces.
    fn declared<T: Growing>() -> Vec<String> {
        let shown = format!("{:#?}", T::default());
        let fields = shown.lines().filter_map(|line| {
            let field = line.strip_prefix("    ")?;
            field
                .starts_with(|letter: char| letter.is_alphabetic())
                .then(|| field.split(':').next())?
        });
        fields.map(str::to_owned).collect()
    }

    #[test]
    fn facts_that_can_grow_cross_with_every_field() {
        assert_eq!(declared::<SensorFacts>(), SensorFacts::FIELDS);
        assert_eq!(declared::<RobotFacts>(), RobotFacts::FIELDS);
        assert_eq!(declared::<ForceFacts>(), ForceFacts::FIELDS);
        assert_eq!(declared::<LightingFacts>(), LightingFacts::FIELDS);
        assert_eq!(declared::<ChangerFacts>(), ChangerFacts::FIELDS);
    }

    fn survive<D: Device + ?Sized + 'static>(registry: &Registry<D>) {
        assert!(!registry.is_empty(), "{:?}", D::KIND);
        for factory in registry.iter() {
            let mut bytes = Vec::new();
            encode(factory.descriptor(), &mut bytes).expect("short");
            assert_eq!(
                decode::<Descriptor>(&bytes).as_ref(),
                Ok(factory.descriptor())
            );
            for cut in 0..bytes.len() {
                assert!(decode::<Descriptor>(&bytes[..cut]).is_err());
            }
        }
    }

    #[test]
    fn the_description_of_every_simulated_device_comes_back_as_it_went() {
        survive(&Registry::<dyn Sensor>::builtin().expect("sound"));
        survive(&Registry::<dyn Robot>::builtin().expect("sound"));
        survive(&Registry::<dyn ForceTransducer>::builtin().expect("sound"));
        survive(&Registry::<dyn Lighting>::builtin().expect("sound"));
    }
}

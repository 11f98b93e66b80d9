//! The plugin `org.example.dmx-light`: a lamp that a program sets.

mod lighting;

use taceva_core::Lighting;

taceva_plugin::export_plugin! {
    id: "org.example.dmx-light",
    needs: ["serial:{port}"],
    drivers: [dyn Lighting => lighting::factory],
}

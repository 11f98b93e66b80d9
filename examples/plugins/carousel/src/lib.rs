//! The plugin `org.example.carousel`: a changer.

mod changer;

use taceva_core::Changer;

taceva_plugin::export_plugin! {
    id: "org.example.carousel",
    needs: ["tcp:{host}:{port}"],
    drivers: [dyn Changer => changer::factory],
}

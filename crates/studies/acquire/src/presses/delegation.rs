//! Macros that delegate methods of a device wrapper to the wrapped device. The argument of each macro is the field with this device.

/// Delegates the methods of a robot that its wrapper does not change. The wrapper has the capabilities of the robot.
macro_rules! delegate_robot {
    ($robot:ident) => {
        fn is_emulated(&self) -> bool {
            self.$robot.is_emulated()
        }

        fn settings(&self) -> std::collections::BTreeMap<String, String> {
            self.$robot.settings()
        }

        fn warnings(&self) -> Vec<String> {
            self.$robot.warnings()
        }

        fn halt_handle(&self) -> std::sync::Arc<dyn taceva_core::Halt> {
            self.$robot.halt_handle()
        }

        fn halt(&mut self) -> Result<(), taceva_core::DriverError> {
            self.$robot.halt()
        }

        fn clear_halt(
            &mut self,
            deadline: taceva_core::Deadline,
        ) -> Result<(), taceva_core::DriverError> {
            self.$robot.clear_halt(deadline)
        }

        fn guarded_motion(&mut self) -> Option<&mut dyn taceva_core::GuardedMotion> {
            match self.$robot.guarded_motion().is_some() {
                true => Some(self),
                false => None,
            }
        }

        fn expiring_motion(&mut self) -> Option<&mut dyn taceva_core::ExpiringMotion> {
            match self.$robot.expiring_motion().is_some() {
                true => Some(self),
                false => None,
            }
        }
    };
}

/// Delegates the methods of a transducer that its wrapper does not change.
macro_rules! delegate_force {
    ($force:ident) => {
        fn start(
            &mut self,
            deadline: taceva_core::Deadline,
        ) -> Result<(), taceva_core::DriverError> {
            self.$force.start(deadline)
        }

        fn sequence(&self) -> Option<u64> {
            self.$force.sequence()
        }

        fn lost(&self) -> Option<u64> {
            self.$force.lost()
        }

        fn stop(&mut self) -> Result<(), taceva_core::DriverError> {
            self.$force.stop()
        }

        fn interrupt_handle(&self) -> Option<std::sync::Arc<dyn taceva_core::Interrupt>> {
            self.$force.interrupt_handle()
        }

        fn settings(&self) -> std::collections::BTreeMap<String, String> {
            self.$force.settings()
        }

        fn warnings(&self) -> Vec<String> {
            self.$force.warnings()
        }

        fn resolution(&self) -> Option<taceva_core::Newton> {
            self.$force.resolution()
        }

        fn tare(&mut self) -> Option<&mut dyn taceva_core::Tare> {
            self.$force.tare()
        }
    };
}

/// Delegates the methods of a sensor that its wrapper does not change, except `settings`.
macro_rules! delegate_sensor {
    ($sensor:ident) => {
        fn frame_info(&self) -> taceva_core::FrameInfo {
            self.$sensor.frame_info()
        }

        fn start(
            &mut self,
            deadline: taceva_core::Deadline,
        ) -> Result<(), taceva_core::DriverError> {
            self.$sensor.start(deadline)
        }

        fn sequence(&self) -> Option<u64> {
            self.$sensor.sequence()
        }

        fn sent(&self) -> Option<&[u8]> {
            self.$sensor.sent()
        }

        fn stop(&mut self) -> Result<(), taceva_core::DriverError> {
            self.$sensor.stop()
        }

        fn interrupt_handle(&self) -> Option<std::sync::Arc<dyn taceva_core::Interrupt>> {
            self.$sensor.interrupt_handle()
        }

        fn is_stamped_by_host(&self) -> bool {
            self.$sensor.is_stamped_by_host()
        }

        fn lighting(&mut self) -> Option<&mut dyn taceva_core::Lighting> {
            self.$sensor.lighting()
        }
    };
}

pub(super) use delegate_force;
pub(super) use delegate_robot;
pub(super) use delegate_sensor;

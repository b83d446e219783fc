"""An algorithm of somebody else's, for the monitor node."""

from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain import MonitorResult, MonitorSettings, Stretch


def always(
    stretch: Stretch, orders: FaultFrequencies, roller_count: int, settings: MonitorSettings
) -> MonitorResult:
    return MonitorResult("roller", "always says so", stretch.end_ns)

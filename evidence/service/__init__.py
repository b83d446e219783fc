"""What a sensor on an axlebox in service receives, and what the monitor says of it.

============== =====================================================
module         responsibility
============== =====================================================
study          runs of the service scenes, and of each part of a background alone
variable_speed docs/evidence/variable_speed.md: the monitor while the speed changes
page           docs/evidence/sensors.md
============== =====================================================
"""

"""What a sensor on an axlebox in service hears, and what the monitor says of it.

======== =====================================================
module   responsibility
======== =====================================================
study    runs of the service scenes, and of each part of a background alone
page     docs/sensors.md
======== =====================================================
"""

# Desk commands and ROS 2 nodes (from wheels), without a screen:
#   docker build -t beardyn . && docker run --rm -v "$PWD:/runs" beardyn beardyn simulate cup_spall -o run.mcap
FROM python:3.11-slim-bookworm

# Libraries that gmsh loads, and what draws the 3-D view without a screen; Debian keeps no old versions to pin.
# hadolint ignore=DL3008
RUN apt-get update \
    && apt-get install --yes --no-install-recommends \
        libglu1-mesa libxcursor1 libxft2 libxinerama1 libxfixes3 xvfb xauth mesa-vulkan-drivers libvulkan1 \
    && rm -rf /var/lib/apt/lists/*

COPY . /source
RUN pip install --no-cache-dir "/source[ros,view,plot,data,sweep,structure,measured]" && rm -rf /source

RUN useradd --uid 1000 --create-home beardyn && mkdir /runs && chown 1000 /runs
USER 1000
WORKDIR /runs
CMD ["beardyn", "--help"]

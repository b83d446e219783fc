// A DDS participant with or without an enclave of SROS 2: peer publish|subscribe TOPIC DOMAIN [ENCLAVE].
// Writes a line for what happens: participant refused, endpoint refused, ready, matched, received.
// Fast DDS 2 is asked for what rmw_fastrtps asks for when ROS_SECURITY_ENABLE is true.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>
#include <thread>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

class Number : public TopicDataType {
 public:
    Number() {
        setName("beardyn::Number");
        m_typeSize = sizeof(uint32_t);
        m_isGetKeyDefined = false;
    }
    bool serialize(void *data, SerializedPayload_t *payload) override {
        std::memcpy(payload->data, data, payload->length = m_typeSize);
        return true;
    }
    bool deserialize(SerializedPayload_t *payload, void *data) override {
        std::memcpy(data, payload->data, m_typeSize);
        return true;
    }
    std::function<uint32_t()> getSerializedSizeProvider(void *) override {
        return [] { return static_cast<uint32_t>(sizeof(uint32_t)); };
    }
    void *createData() override { return new uint32_t(); }
    void deleteData(void *data) override { delete static_cast<uint32_t *>(data); }
    bool getKey(void *, InstanceHandle_t *, bool) override { return false; }
};

static void tell(const char *what) {
    std::printf("%s\n", what);
    std::fflush(stdout);
}

class Ear : public DataReaderListener {
    void on_subscription_matched(DataReader *, const SubscriptionMatchedStatus &now) override {
        if (now.current_count_change > 0) tell("matched");
    }
    void on_data_available(DataReader *reader) override {
        uint32_t number;
        SampleInfo info;
        while (reader->take_next_sample(&number, &info) == ReturnCode_t::RETCODE_OK)
            if (info.valid_data) tell("received");
    }
};

static DomainParticipantQos secured(const std::string &enclave) {
    DomainParticipantQos qos;
    const std::string file = "file://" + enclave + "/", access = "dds.sec.access.builtin.Access-Permissions.",
                      identity = "dds.sec.auth.builtin.PKI-DH.";
    auto &given = qos.properties().properties();
    given.emplace_back("dds.sec.auth.plugin", "builtin.PKI-DH");
    given.emplace_back(identity + "identity_ca", file + "identity_ca.cert.pem");
    given.emplace_back(identity + "identity_certificate", file + "cert.pem");
    given.emplace_back(identity + "private_key", file + "key.pem");
    given.emplace_back("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
    given.emplace_back("dds.sec.access.plugin", "builtin.Access-Permissions");
    given.emplace_back(access + "permissions_ca", file + "permissions_ca.cert.pem");
    given.emplace_back(access + "governance", file + "governance.p7s");
    given.emplace_back(access + "permissions", file + "permissions.p7s");
    return qos;
}

int main(int count, char **words) {
    if (count < 4) return 2;
    const bool speaks = !std::strcmp(words[1], "publish");
    auto *participant = DomainParticipantFactory::get_instance()->create_participant(
        std::atoi(words[3]), count > 4 ? secured(words[4]) : DomainParticipantQos());
    if (!participant) return tell("participant refused"), 0;
    TypeSupport type(new Number());
    type.register_type(participant);
    auto *topic = participant->create_topic(words[2], type.get_type_name(), TOPIC_QOS_DEFAULT);
    if (!speaks) {
        Ear ear;
        DataReaderQos qos;
        qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
        auto *reader = participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT)->create_datareader(topic, qos, &ear);
        if (!reader) return tell("endpoint refused"), 0;
        tell("ready");
        for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    auto *writer = participant->create_publisher(PUBLISHER_QOS_DEFAULT)->create_datawriter(topic, DATAWRITER_QOS_DEFAULT);
    if (!writer) return tell("endpoint refused"), 0;
    tell("ready");
    for (uint32_t number = 0;; number++) {
        writer->write(&number);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}
